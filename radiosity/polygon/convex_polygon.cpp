#include "radiosity/polygon/convex_polygon.h"

#include <cmath>

namespace radiosity {
namespace {

/// How far corners are above a plane, where those within the thickness are in it.
struct Heights {
  std::array<double, ConvexPolygon::kCapacity> of_corner;
  bool any_above = false;
  bool any_below = false;

  Heights(std::span<const Vec3> polygon, const Vec3& on_plane, const Vec3& normal,
          double thickness) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const double height = normal.dot(polygon[k] - on_plane);
      of_corner[k] = std::abs(height) <= thickness ? 0 : height;
      any_above |= of_corner[k] > 0;
      any_below |= of_corner[k] < 0;
    }
  }

  /// The same with one run of `n` corners at most on either side, as convex polygons have: what
  /// rounding put on the wrong side is in the plane.
  [[nodiscard]] Heights in_two_runs(std::size_t n) const {
    std::array<bool, ConvexPolygon::kCapacity> is_kept{};
    for (const double sign : {1.0, -1.0}) {
      std::size_t furthest = 0;
      for (std::size_t k = 1; k < n; ++k) {
        if (sign * of_corner[k] > sign * of_corner[furthest]) furthest = k;
      }
      for (const std::size_t step : {std::size_t{1}, n - 1}) {
        for (std::size_t i = 0, k = furthest; i < n && sign * of_corner[k] >= 0; ++i) {
          is_kept[k] = true;
          k = (k + step) % n;
        }
      }
    }
    Heights result = *this;
    for (std::size_t k = 0; k < n; ++k) {
      if (!is_kept[k]) result.of_corner[k] = 0;
    }
    return result;
  }
};

/// The part above the plane, with a sign of -1 that below it.
void find_above(std::span<const Vec3> polygon, const Heights& heights, double sign,
                ConvexPolygon& result) {
  result.clear();
  int n_crossings = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = k + 1 < polygon.size() ? k + 1 : 0;
    const double height = heights.of_corner[k];
    const double height_next = heights.of_corner[next];
    if (sign * height >= 0) result.push_back(polygon[k]);
    if (height * height_next < 0) {
      if (++n_crossings > 2) {
        find_above(polygon, heights.in_two_runs(polygon.size()), sign, result);
        return;
      }
      const double s = height / (height - height_next);
      result.push_back(polygon[k] + s * (polygon[next] - polygon[k]));
    }
  }
}

}  // namespace

Disc bounding_disc(std::span<const Vec3> polygon) {
  Vec3 center = Vec3::Zero();
  for (const Vec3& point : polygon) center += point;
  center /= static_cast<double>(polygon.size());
  double square = 0;
  for (const Vec3& point : polygon) square = std::max(square, (point - center).squaredNorm());
  return {center, std::sqrt(square)};
}

std::vector<ConvexPolygon> divide_about_corners(const ConvexPolygon& polygon) {
  const Vec3 middle = bounding_disc(polygon.points()).center;
  const std::size_t n = polygon.size();
  std::vector<ConvexPolygon> pieces(n);
  for (std::size_t k = 0; k < n; ++k) {
    pieces[k].push_back(polygon[k]);
    pieces[k].push_back(0.5 * (polygon[k] + polygon[(k + 1) % n]));
    pieces[k].push_back(middle);
    pieces[k].push_back(0.5 * (polygon[k] + polygon[(k + n - 1) % n]));
  }
  return pieces;
}

ConvexPolygon clip_to_half_space(std::span<const Vec3> polygon, const Vec3& on_plane,
                                 const Vec3& normal, double thickness) {
  const Heights heights(polygon, on_plane, normal, thickness);
  ConvexPolygon result;
  if (!heights.any_above) return result;
  if (!heights.any_below) return ConvexPolygon(polygon);
  find_above(polygon, heights, 1, result);
  return result;
}

bool keep_above(const Vec3& on_plane, const Vec3& normal, ConvexPolygon& polygon) {
  const Heights heights(polygon.points(), on_plane, normal, 0);
  if (!heights.any_above) {
    polygon.clear();
  } else if (heights.any_below) {
    const ConvexPolygon whole = polygon;
    find_above(whole.points(), heights, 1, polygon);
  }
  return !polygon.empty();
}

bool split(const ConvexPolygon& polygon, const Vec3& on_plane, const Vec3& normal, double thickness,
           ConvexPolygon& above, ConvexPolygon& below) {
  const Heights heights(polygon.points(), on_plane, normal, thickness);
  if (!heights.any_above || !heights.any_below) {
    above.clear();
    below.clear();
    (heights.any_above ? above : below) = polygon;
    return false;
  }
  find_above(polygon.points(), heights, 1, above);
  find_above(polygon.points(), heights, -1, below);
  return true;
}

}  // namespace radiosity
