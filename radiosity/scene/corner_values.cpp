#include "radiosity/scene/corner_values.h"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// How far a corner at the border of a surface may go beyond its patches' values, relative to them.
constexpr double kBorderOvershoot = 0.25;

/// Two unit vectors (columns) that span the plane of a patch.
Eigen::Matrix<double, 3, 2> tangents(const Vec3& normal) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = normal.unitOrthogonal();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

/// Pseudo-inverse of a symmetric positive semidefinite matrix. Neighbours in one row tell nothing
/// about the direction across it, where the gradient is then taken as 0.
Eigen::Matrix2d pseudo_inverse(const Eigen::Matrix2d& matrix) {
  constexpr double kUnknownDirection = 1e-3;  // of the eigenvalues' ratio
  const double mean = 0.5 * (matrix(0, 0) + matrix(1, 1));
  const double half = 0.5 * (matrix(0, 0) - matrix(1, 1));
  const double radius = std::hypot(half, matrix(1, 0));
  const double largest = mean + radius;
  const double smallest = mean - radius;
  if (smallest > kUnknownDirection * largest) return matrix.inverse();
  if (largest <= 0) return Eigen::Matrix2d::Zero();
  // (M - smallest) / (largest - smallest) projects on the direction of the largest.
  const Eigen::Matrix2d projection =
      (matrix - smallest * Eigen::Matrix2d::Identity()) / (2 * radius);
  return projection / largest;
}

/// Gradient of the values at patch i, 1/m, 3 x n_bands, in the plane of the patch: the weighted
/// least-squares fit to the differences from the patches that share a corner group with it.
Eigen::MatrixXd gradient(const PatchMesh& mesh, const SmoothCorners& groups,
                         const Eigen::MatrixXd& patch_values, const std::vector<bool>& is_dark,
                         Index i) {
  const Eigen::Matrix<double, 3, 2> basis = tangents(mesh.normal[i]);
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(2, patch_values.cols());
  for (int k = 0; k < mesh.n_corners(i); ++k) {
    // A neighbour across an edge shares two corners and so counts twice, as it should.
    for (const std::int64_t slot : groups.group(groups.group_of[4 * i + k])) {
      const Index j = slot / 4;
      const Eigen::Vector2d step = basis.transpose() * (mesh.centroid[j] - mesh.centroid[i]);
      if (j == i || step.isZero(0) || is_dark[j] != is_dark[i]) continue;
      const Eigen::Vector2d weighted = step / step.squaredNorm();
      matrix += weighted * step.transpose();
      right += weighted * (patch_values.row(j) - patch_values.row(i));
    }
  }
  return basis * (pseudo_inverse(matrix) * right);
}

/// The common value of corners of one group, from the extrapolations in their slots' rows.
Eigen::RowVectorXd joined_value(const PatchMesh& mesh, const SmoothCorners& groups,
                                const Eigen::MatrixXd& patch_values,
                                const Eigen::MatrixXd& extrapolated, Index group,
                                std::span<const std::int64_t> slots) {
  const Eigen::RowVectorXd first = extrapolated.row(slots[0]);
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(patch_values.cols());
  Eigen::RowVectorXd low = patch_values.row(slots[0] / 4);
  Eigen::RowVectorXd high = low;
  double weights = 0;
  for (const std::int64_t slot : slots) {
    const double weight = corner_angle(mesh, slot / 4, static_cast<int>(slot % 4));
    weights += weight;
    sum += weight * (extrapolated.row(slot) - first);
    low = low.cwiseMin(patch_values.row(slot / 4));
    high = high.cwiseMax(patch_values.row(slot / 4));
  }
  if (groups.is_interior[group] == 0) {
    low -= kBorderOvershoot * low.cwiseAbs();
    high += kBorderOvershoot * high.cwiseAbs();
  }
  if (weights > 0) sum /= weights;
  return (first + sum).cwiseMax(low).cwiseMin(high);
}

/// Gives T-vertices the values of the edges that they lie on. The ends of these may be T-vertices
/// themselves, in the worst case in a circle (pinwheel), hence the repetition.
void resolve_t_vertices(const SmoothCorners& groups, const std::vector<bool>& is_dark,
                        Eigen::MatrixXd& values) {
  constexpr int kMaxPasses = 50;
  bool has_changed = !groups.t_vertices.empty();
  for (int pass = 0; pass < kMaxPasses && has_changed; ++pass) {
    has_changed = false;
    for (const TVertex& vertex : groups.t_vertices) {
      const Eigen::RowVectorXd value =
          values.row(vertex.from) + vertex.t * (values.row(vertex.to) - values.row(vertex.from));
      for (const std::int64_t slot : groups.group(vertex.group)) {
        if (is_dark[slot / 4] != is_dark[vertex.from / 4]) continue;
        if (!value.isApprox(values.row(slot), 1e-14)) has_changed = true;
        values.row(slot) = value;
      }
    }
  }
}

}  // namespace

Eigen::MatrixXd CornerInterpolation::values(const Eigen::MatrixXd& patch_values) const {
  assert(patch_values.rows() == mesh_.size());
  constexpr Index kGrain = 256;
  std::vector<bool> is_dark(mesh_.size());
  for (Index i = 0; i < mesh_.size(); ++i) is_dark[i] = patch_values.row(i).isZero(0);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(4 * mesh_.size(), patch_values.cols());
  parallel_for(
      mesh_.size(),
      [&](Index i) {
        const Eigen::MatrixXd slope = gradient(mesh_, groups_, patch_values, is_dark, i);
        for (int k = 0; k < mesh_.n_corners(i); ++k) {
          const Vec3 offset = mesh_.corner(i, k) - mesh_.centroid[i];
          values.row(4 * i + k) = patch_values.row(i) + offset.transpose() * slope;
        }
      },
      kGrain);
  parallel_for(
      groups_.size(),
      [&](Index g) {
        std::vector<std::int64_t> lit;
        for (const std::int64_t slot : groups_.group(g)) {
          if (!is_dark[slot / 4]) lit.push_back(slot);
        }
        if (lit.empty()) return;
        const Eigen::RowVectorXd value = joined_value(mesh_, groups_, patch_values, values, g, lit);
        for (const std::int64_t slot : lit) values.row(slot) = value;
      },
      kGrain);
  resolve_t_vertices(groups_, is_dark, values);
  for (Index i = 0; i < mesh_.size(); ++i) {
    if (mesh_.n_corners(i) == 3) values.row(4 * i + 3) = values.row(4 * i + 2);
  }
  return values;
}

Eigen::MatrixXd corner_values(const PatchMesh& mesh, const Eigen::MatrixXd& patch_values,
                              double crease_angle) {
  return CornerInterpolation(mesh, crease_angle).values(patch_values);
}

}  // namespace radiosity
