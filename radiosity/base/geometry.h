#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
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

inline double square(double x) { return x * x; }

/// The point of a triangle that (u, v) of the unit square is mapped to, evenly. (Turk 1990)
inline Vec3 triangle_point(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v) {
  const double root = std::sqrt(u);
  return a + root * (1 - v) * (b - a) + root * v * (c - a);
}

/// The box with all its sides moved outwards by `margin`, m.
inline Box3 grown(Box3 box, double margin) {
  box.min().array() -= margin;
  box.max().array() += margin;
  return box;
}

/// Whether the segment from `start` to `end` lies along an edge of a closed outline of n corners,
/// both ends no further than `margin` from its line. `corner(k)` is a corner, k < n.
template <typename Corner>
bool is_along_edge(const Vec3& start, const Vec3& end, int n, const Corner& corner, double margin) {
  for (int k = 0; k < n; ++k) {
    const Vec3& a = corner(k);
    const Vec3 edge = (corner((k + 1) % n) - a).normalized();
    const auto distance = [&](const Vec3& x) { return (x - a).cross(edge).norm(); };
    if (distance(start) <= margin && distance(end) <= margin) return true;
  }
  return false;
}

}  // namespace radiosity
