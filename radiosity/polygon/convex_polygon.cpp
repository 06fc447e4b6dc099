#include "radiosity/polygon/convex_polygon.h"

#include <cmath>

namespace radiosity {

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
  std::array<double, ConvexPolygon::kCapacity> height{};
  bool any_above = false;
  bool any_below = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    height[k] = normal.dot(polygon[k] - on_plane);
    if (std::abs(height[k]) <= thickness) height[k] = 0;
    any_above |= height[k] > 0;
    any_below |= height[k] < 0;
  }
  if (!any_above) return {};
  if (!any_below) return ConvexPolygon(polygon);

  ConvexPolygon result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = k + 1 < polygon.size() ? k + 1 : 0;
    if (height[k] >= 0) result.push_back(polygon[k]);
    if (height[k] * height[next] < 0) {
      const double s = height[k] / (height[k] - height[next]);
      result.push_back(polygon[k] + s * (polygon[next] - polygon[k]));
    }
  }
  return result;
}

}  // namespace radiosity
