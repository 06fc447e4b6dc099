#include "radiosity/polygon/flat_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiosity/base/box_tree.h"

namespace radiosity {
namespace {

/// Whether an edge of `a` separates it from `b`: b lies outside it but for `thickness`.
bool is_separated_by_edge(const std::vector<Point2>& a, const std::vector<Point2>& b,
                          double thickness) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Point2 edge = a[k + 1 < a.size() ? k + 1 : 0] - a[k];
    const double limit = thickness * edge.norm();
    if (std::all_of(b.begin(), b.end(),
                    [&](const Point2& point) { return cross2(edge, point - a[k]) <= limit; })) {
      return true;
    }
  }
  return false;
}

/// Whether a point lies within a convex polygon that is grown by `reach`, or shrunk if it is below
/// 0.
bool has_within(const std::vector<Point2>& polygon, const Point2& point, double reach) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point2 edge = polygon[k + 1 < polygon.size() ? k + 1 : 0] - polygon[k];
    if (cross2(edge, point - polygon[k]) < -reach * edge.norm()) return false;
  }
  return true;
}

/// Directions that are tried about a corner.
constexpr int kDirections = 12;
/// Of a gap's width: what polygons are grown by.
constexpr double kGrown = 0.125;

}  // namespace

bool has_overlap(const std::vector<std::vector<Point2>>& polygons, double thickness) {
  std::vector<Eigen::AlignedBox2d> boxes(polygons.size());
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    for (const Point2& point : polygons[k]) boxes[k].extend(point);
  }
  std::vector<std::size_t> sorted(polygons.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(),
            [&](std::size_t a, std::size_t b) { return boxes[a].min().x() < boxes[b].min().x(); });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const std::size_t a = sorted[i];
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      const std::size_t b = sorted[j];
      if (boxes[b].min().x() >= boxes[a].max().x() - thickness) break;
      if (boxes[b].min().y() >= boxes[a].max().y() - thickness ||
          boxes[a].min().y() >= boxes[b].max().y() - thickness) {
        continue;
      }
      if (!is_separated_by_edge(polygons[a], polygons[b], thickness) &&
          !is_separated_by_edge(polygons[b], polygons[a], thickness)) {
        return true;
      }
    }
  }
  return false;
}

bool has_gap(const std::vector<std::vector<Point2>>& polygons, const std::vector<Point2>& hull,
             double width) {
  const auto box_of = [](const Point2& point) { return Vec3(point.x(), point.y(), 0); };
  std::vector<Box3> boxes(polygons.size());
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    for (const Point2& point : polygons[k]) boxes[k].extend(box_of(point));
  }
  const BoxTree tree(std::move(boxes));
  const Vec3 around = Vec3(2, 2, 0) * width;
  std::vector<std::int32_t> near;
  for (const std::vector<Point2>& polygon : polygons) {
    for (const Point2& corner : polygon) {
      near.clear();
      const Vec3 place = box_of(corner);
      tree.for_each_meeting(Box3(place - around, place + around),
                            [&](std::int32_t k) { near.push_back(k); });
      for (int d = 0; d < kDirections; ++d) {
        const double angle = 2 * kPi * (d + 0.3) / kDirections;
        const Point2 point = corner + width * Point2(std::cos(angle), std::sin(angle));
        const bool is_free =
            has_within(hull, point, -kGrown * width) &&
            std::none_of(near.begin(), near.end(), [&](std::int32_t k) {
              return has_within(polygons[static_cast<std::size_t>(k)], point, kGrown * width);
            });
        if (is_free) return true;
      }
    }
  }
  return false;
}

}  // namespace radiosity
