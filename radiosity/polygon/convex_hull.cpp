#include "radiosity/polygon/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {

namespace {

/// Points outside the hull by this many thicknesses are not rounding.
constexpr double kSlack = 4;

bool holds_all(const std::vector<std::int32_t>& hull, const std::vector<Point2>& points,
               double thickness) {
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Point2& start = points[hull[k]];
    const Point2 edge = points[hull[k + 1 < hull.size() ? k + 1 : 0]] - start;
    const double least = -kSlack * thickness * edge.norm();
    if (std::any_of(points.begin(), points.end(),
                    [&](const Point2& point) { return cross2(edge, point - start) < least; })) {
      return false;
    }
  }
  return hull.size() >= 3;
}

}  // namespace

std::vector<std::int32_t> convex_hull(const std::vector<Point2>& points, double thickness,
                                      std::size_t most_corners) {
  if (points.size() < 3) return {};
  // Along a direction that is hardly ever an edge's normal: points that rounding alone puts in
  // order would make spikes.
  const Point2 along(std::cos(0.6180339887), std::sin(0.6180339887));
  std::vector<std::pair<double, std::int32_t>> sorted;
  sorted.reserve(points.size());
  for (const Point2& point : points) {
    sorted.emplace_back(along.dot(point), static_cast<std::int32_t>(sorted.size()));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> hull;
  const auto extend = [&](std::int32_t next, std::size_t keep) {
    while (hull.size() > keep) {
      const Point2& a = points[hull[hull.size() - 2]];
      const Point2& b = points[hull.back()];
      const Point2 chord = points[next] - a;
      if (cross2(b - a, chord) > thickness * chord.norm()) break;
      hull.pop_back();
    }
    hull.push_back(next);
  };
  for (const auto& [place, k] : sorted) extend(k, 1);
  const std::size_t lower = hull.size();
  for (auto it = sorted.rbegin() + 1; it != sorted.rend(); ++it) extend(it->second, lower);
  hull.pop_back();
  if (hull.size() > most_corners || !holds_all(hull, points, thickness)) return {};
  return hull;
}

}  // namespace radiosity
