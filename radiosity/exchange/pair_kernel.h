#pragma once

#include <array>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/visibility/blocking.h"
#include "radiosity/visibility/half_space.h"
#include "radiosity/visibility/prepared_mesh.h"

namespace radiosity {

/// The kernel of pairs of patches that see each other, with each patch's quadrature points laid out
/// for speed.
class PairKernel {
 public:
  /// `tolerance` is the relative error of the unoccluded exchange areas. The mesh must outlive
  /// this.
  PairKernel(const PreparedMesh& mesh, double tolerance);

  /// How much of patch j lies in front of patch i: nothing, some, or all of it.
  [[nodiscard]] Blocking in_front(Index i, Index j) const;

  /// Exchange area of two patches without occlusion, m², given how much of either lies in front
  /// of the other.
  [[nodiscard]] double unoccluded(Index i, Index j, Blocking front_i, Blocking front_j) const;
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  /// Rules up to this order are kept for every patch; larger ones, for near pairs, are made anew.
  static constexpr int kKeptOrder = 4;
  struct Rule {
    std::vector<double> x, y, z, weight;
  };
  /// As area_rule_order does.
  [[nodiscard]] int rule_order(double distance_ratio) const;
  void find_points(Index i, int order, const HalfSpace& other, WeightedPoints& points) const;

  const PreparedMesh& mesh_;
  std::array<Rule, kKeptOrder - 1> rules_;  // orders 2, ...: padded_points(order) entries a patch
  double tolerance_;
  std::array<double, kLargestAreaRule + 1> least_ratio_;  // per order: of distance to radius
};

}  // namespace radiosity
