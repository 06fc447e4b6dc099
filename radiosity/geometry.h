#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

namespace radiosity {

using Vec3 = Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;
using Index = Eigen::Index;

inline constexpr double kPi = 3.14159265358979323846;

/// Vector area of a closed polygon, m²: its length is the area of a planar polygon, its direction
/// the normal about which the vertices run counter-clockwise. (Newell's method: half the sum of
/// the cross products of consecutive vertices, taken about the first one to keep digits when the
/// polygon lies far from the origin.)
inline Vec3 vector_area(std::span<const Vec3> polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    sum += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
  }
  return 0.5 * sum;
}

}  // namespace radiosity
