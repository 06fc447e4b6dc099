#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/compressed/nested_basis.h"
#include "radiosity/compressed/polynomial_space.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/cluster_tree.h"

namespace radiosity {

/// Polynomials on the patches of each cluster of a tree: of the centroid's two coordinates in the
/// plane that the patches share, else of its three coordinates and the normal's. Orthonormal with
/// the areas as weights, Σ_i A_i p_k(i) p_l(i) = A δ_kl, by rising degree; the first is 1. Where
/// patches are few, or in line, there are fewer.
class ClusterPolynomials {
 public:
  static constexpr int kMostDegree = NestedBasis::kMostDegree;  ///< in a plane
  static constexpr int kMostCurvedDegree = 2;                   ///< elsewhere
  static constexpr int kMost = 28;                              ///< polynomials of a cluster

  /// `tree` is the mesh's; both must outlive this.
  ClusterPolynomials(const PatchMesh& mesh, const ClusterTree& tree);

  /// Number of polynomials of a cluster up to each degree.
  [[nodiscard]] const std::array<std::uint8_t, kMostDegree + 1>& counts(
      std::int32_t cluster) const {
    return built_[cluster].counts;
  }
  [[nodiscard]] int most_degree(std::int32_t cluster) const {
    return frames_[cluster].is_planar ? kMostDegree : kMostCurvedDegree;
  }
  [[nodiscard]] double area(std::int32_t cluster) const { return built_[cluster].area; }  ///< m²

  /// The polynomials of a cluster up to a degree, at one of its patches.
  void evaluate(std::int32_t cluster, std::int32_t patch, int degree, double* values) const;

  /// What sums over patches need, with the polynomials up to the degree that each cluster is needed
  /// with (-1: not by itself) and those that its parents' are made of.
  [[nodiscard]] NestedBasis make_basis(const std::vector<std::int8_t>& degrees) const;

 private:
  struct Frame {
    Vec3 center = Vec3::Zero();
    Vec3 u = Vec3::Zero();  // axes of the plane, if there is one
    Vec3 v = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  // mean
    double size = 1;             // m
    bool is_planar = false;
  };
  struct Built {
    std::array<std::uint8_t, kMostDegree + 1> counts{};
    double area = 0;
    Eigen::MatrixXf coefficients;  // of the monomials: count x monomials
    Eigen::MatrixXf transfer;      // the parent's as combinations of these: its count x count
  };
  /// The first n of all functions, with those that only the parent's are made of.
  void evaluate_first(std::int32_t cluster, std::int32_t patch, int n, double* values) const;
  /// `parent` is -1 of the root.
  void build(std::int32_t cluster, std::int32_t parent);
  /// Σ_i A_i z_k(i) z_l(i) / A of the monomials.
  [[nodiscard]] Eigen::MatrixXd gram_matrix(std::int32_t cluster) const;
  [[nodiscard]] Frame make_frame(std::int32_t cluster, const Frame* plane) const;
  [[nodiscard]] const PolynomialSpace& space(const Frame& frame) const {
    return frame.is_planar ? planar_ : curved_;
  }
  void coordinates(const Frame& frame, std::int32_t patch, double* point) const;
  /// The coordinates of `outer` as affine functions of those of `inner`.
  [[nodiscard]] static Eigen::MatrixXd coordinate_map(const Frame& outer, const Frame& inner);

  const PatchMesh& mesh_;
  const ClusterTree& tree_;
  PolynomialSpace planar_;
  PolynomialSpace curved_;
  std::vector<Frame> frames_;
  std::vector<Built> built_;
};

}  // namespace radiosity
