#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace radiosity {

using Point2 = Eigen::Vector2d;

inline double cross2(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Indices of the corners of the convex hull of points in a plane, counter-clockwise, without those
/// that lie on its edges but for `thickness`. Empty if the points are (nearly) in a line, or if it
/// has more than `most_corners`; the time is n log n + n x corners, at most `most_corners`. (Andrew
/// 1979)
std::vector<std::int32_t> convex_hull(
    const std::vector<Point2>& points, double thickness,
    std::size_t most_corners = std::numeric_limits<std::size_t>::max());

}  // namespace radiosity
