#include "viewer/desk/patch_points.h"

#include <utility>

namespace viewer {

using radiosity::Index;

PatchPoints::PatchPoints(std::shared_ptr<const radiosity::PatchMesh> mesh)
    : mesh_(std::move(mesh)), interpolation_(*mesh_) {
  for (Index i = 0; i < mesh_->size(); ++i) {
    const auto first = static_cast<std::int32_t>(positions_.size());
    const int n = mesh_->n_corners(i);
    has_back_.insert(has_back_.end(), n == 3 ? 1 : 4, mesh_->twin[i] < 0 ? 1 : 0);
    surfaces_.insert(surfaces_.end(), n == 3 ? 1 : 4, mesh_->surface[i]);
    radiosity::Vec3 sum = radiosity::Vec3::Zero();
    for (int k = 0; k < n; ++k) {
      positions_.push_back(mesh_->corner(i, k));
      sum += mesh_->corner(i, k);
    }
    if (n == 3) {
      triangles_.push_back({first, first + 1, first + 2});
      continue;
    }
    positions_.emplace_back(sum / n);
    for (int k = 0; k < n; ++k) {
      triangles_.push_back({first + k, first + (k + 1) % n, first + n});
    }
  }
}

Eigen::MatrixXd PatchPoints::values(const Eigen::MatrixXd& patch_values, bool smooth) const {
  Eigen::MatrixXd result(static_cast<Index>(positions_.size()), patch_values.cols());
  const Eigen::MatrixXd corners = smooth ? interpolation_.values(patch_values) : Eigen::MatrixXd();
  Index row = 0;
  for (Index i = 0; i < mesh_->size(); ++i) {
    const int n = mesh_->n_corners(i);
    if (!smooth) {
      const int n_points = n == 3 ? 3 : 5;
      for (int k = 0; k < n_points; ++k) result.row(row++) = patch_values.row(i);
      continue;
    }
    for (int k = 0; k < n; ++k) result.row(row++) = corners.row(4 * i + k);
    if (n == 4) result.row(row++) = corners.middleRows(4 * i, 4).colwise().mean();
  }
  return result;
}

}  // namespace viewer
