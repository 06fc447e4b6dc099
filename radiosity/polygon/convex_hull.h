#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace radiosity {

using Point2 = Eigen::Vector2d;

inline double cross2(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Indices of the corners of the convex hull of points in a plane, counter-clockwise, without those
/// that lie on its edges but for `thickness`. Empty if the points are (nearly) in a line. (Andrew
/// 1979)
std::vector<std::int32_t> convex_hull(const std::vector<Point2>& points, double thickness);

}  // namespace radiosity
