#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"

namespace meshing {

using Vec2 = Eigen::Vector2d;
using Triangle = std::array<std::int32_t, 3>;

/// Coordinates in the mean plane of a polygon, in units of its extent and about its first corner,
/// so that tolerances hold at every scale and far from the origin.
class PlaneFrame {
 public:
  /// `polygon` has a non-zero vector area.
  explicit PlaneFrame(std::span<const radiosity::Vec3> polygon);

  [[nodiscard]] Vec2 to_plane(const radiosity::Vec3& point) const;
  [[nodiscard]] radiosity::Vec3 to_space(const Vec2& point) const;
  /// Length of one plane unit, m.
  [[nodiscard]] double unit() const { return unit_; }

 private:
  radiosity::Vec3 origin_, u_, v_;
  double unit_;
};

/// Twice the signed area of the triangle a b c, > 0 if counter-clockwise.
double signed_area2(const Vec2& a, const Vec2& b, const Vec2& c);

/// True if two edges of the polygon cross properly; touching and running along each other (the slit
/// that joins a hole to the outline) is not crossing. Coordinates of order one.
bool crosses_itself(std::span<const Vec2> polygon);

/// Triangulates a simple polygon that runs counter-clockwise, coordinates of order one, by clipping
/// ears. Corners in the middle of a straight edge stay corners of triangles and no triangle is
/// degenerate. Returns n - 2 triangles of corner indices, or nothing if the polygon crosses itself.
std::optional<std::vector<Triangle>> clip_ears(std::span<const Vec2> polygon);

}  // namespace meshing
