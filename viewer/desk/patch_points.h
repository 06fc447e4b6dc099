#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/corner_values.h"
#include "radiosity/scene/patch_mesh.h"

namespace viewer {

/// The patches as triangles for a graphics card. Each patch has points of its own, so that colours
/// may jump from one to the next; a quad is four triangles about its centre, since two would show
/// their diagonal.
class PatchPoints {
 public:
  explicit PatchPoints(std::shared_ptr<const radiosity::PatchMesh> mesh);

  [[nodiscard]] const std::vector<radiosity::Vec3>& positions() const { return positions_; }
  [[nodiscard]] const std::vector<std::array<std::int32_t, 3>>& triangles() const {
    return triangles_;
  }
  /// Per triangle: whether its back is shown, as no patch lies there; 0 or 1.
  [[nodiscard]] const std::vector<std::uint8_t>& has_back() const { return has_back_; }
  /// Per triangle.
  [[nodiscard]] const std::vector<std::int32_t>& surfaces() const { return surfaces_; }
  /// The points' values of a field of patches, n_points x k: with `smooth` as `corner_values` has
  /// them, else constant on each patch.
  [[nodiscard]] Eigen::MatrixXd values(const Eigen::MatrixXd& patch_values, bool smooth) const;

 private:
  std::shared_ptr<const radiosity::PatchMesh> mesh_;
  radiosity::CornerInterpolation interpolation_;
  std::vector<radiosity::Vec3> positions_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::uint8_t> has_back_;
  std::vector<std::int32_t> surfaces_;
};

}  // namespace viewer
