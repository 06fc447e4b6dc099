#include "radiosity/polygon/flat_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

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

}  // namespace radiosity
