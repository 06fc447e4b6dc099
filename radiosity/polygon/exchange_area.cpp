#include "radiosity/polygon/exchange_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "radiosity/polygon/contour_integral.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/polygon/polygon_quadrature.h"

namespace radiosity {
namespace {

/// Vertices this close to a plane, relative to the size of the pair, lie on it.
constexpr double kOnPlane = 1e-14;

/// Form factors below this between near polygons (they lie almost in one plane) need no more
/// absolute accuracy than this one.
constexpr double kNegligible = 1e-4;

ConvexPolygon moved_and_scaled(const ConvexPolygon& polygon, const Vec3& origin, double scale) {
  ConvexPolygon result;
  for (const Vec3& point : polygon) result.push_back((point - origin) * scale);
  return result;
}

/// ∫ over polygon1 of the point-to-polygon form factor, by Gauss rules on pieces that are halved
/// until two levels agree to `tolerance`. For polygons that keep a distance.
Estimate outer_quadrature(const ConvexPolygon& polygon1, const Vec3& normal1,
                          const ConvexPolygon& polygon2, double tolerance, int depth) {
  const auto integral = [&](int order) {
    double sum = 0;
    for_each_quadrature_point(polygon1.points(), order, [&](const Vec3& point, double weight) {
      sum += weight * point_to_polygon(point, normal1, polygon2.points());
    });
    return sum;
  };
  const double coarse = integral(6);
  const double fine = integral(10);
  const double error = std::abs(fine - coarse);
  if (error <= tolerance || depth == 0) return {fine, error};

  Estimate sum;
  for (const ConvexPolygon& piece : divide_about_corners(polygon1)) {
    const Estimate part = outer_quadrature(piece, normal1, polygon2, tolerance / 2, depth - 1);
    sum.value += part.value;
    sum.error += part.error;
  }
  return sum;
}

/// A pair moved to the origin and scaled to order 1, clipped to each other's front.
struct FacingPair {
  ConvexPolygon polygon1;
  ConvexPolygon polygon2;
  Vec3 normal1;
  Vec3 normal2;
};

Estimate touching_or_near(const FacingPair& pair, double tolerance) {
  Estimate best = contour_exchange_area(pair.polygon1.points(), pair.polygon2.points());
  const double least_area = std::min(vector_area(pair.polygon1.points()).norm(),
                                     vector_area(pair.polygon2.points()).norm());
  const double goal = tolerance * std::max(std::abs(best.value), kNegligible * least_area);
  if (best.error <= goal) return best;

  const Disc disc1 = bounding_disc(pair.polygon1.points());
  const Disc disc2 = bounding_disc(pair.polygon2.points());
  const bool first_is_smaller = disc1.radius <= disc2.radius;
  const auto by_area = [&] {
    constexpr int kDepth = 6;
    return first_is_smaller
               ? outer_quadrature(pair.polygon1, pair.normal1, pair.polygon2, goal, kDepth)
               : outer_quadrature(pair.polygon2, pair.normal2, pair.polygon1, goal, kDepth);
  };
  const auto by_contour = [&] {
    return contour_exchange_area_adaptive(pair.polygon1.points(), pair.polygon2.points(),
                                          0.1 * goal);
  };
  const bool is_apart = (disc1.center - disc2.center).norm() > disc1.radius + disc2.radius;
  const Estimate second = is_apart ? by_area() : by_contour();
  if (second.error < best.error) best = second;
  if (best.error <= goal) return best;
  const Estimate third = is_apart ? by_contour() : by_area();
  return third.error < best.error ? third : best;
}

double facing_exchange_area(const FacingPair& pair, double tolerance) {
  const Disc disc1 = bounding_disc(pair.polygon1.points());
  const Disc disc2 = bounding_disc(pair.polygon2.points());
  const double distance = (disc1.center - disc2.center).norm();
  const int order1 = area_rule_order((distance - disc2.radius) / disc1.radius, tolerance);
  const int order2 = area_rule_order((distance - disc1.radius) / disc2.radius, tolerance);
  if (order1 > 0 && order2 > 0) {
    return area_rule_exchange_area(pair.polygon1.points(), pair.normal1, order1,
                                   pair.polygon2.points(), pair.normal2, order2);
  }
  return std::max(0.0, touching_or_near(pair, tolerance).value);
}

double convex_exchange_area(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2,
                            double tolerance) {
  const Vec3 area1 = vector_area(polygon1);
  const Vec3 area2 = vector_area(polygon2);
  const double size1 = area1.norm();
  const double size2 = area2.norm();
  if (size1 == 0 || size2 == 0) return 0;
  const Vec3 normal1 = area1 / size1;
  const Vec3 normal2 = area2 / size2;

  Box3 box;
  for (const Vec3& point : polygon1) box.extend(point);
  for (const Vec3& point : polygon2) box.extend(point);
  const double extent = box.diagonal().norm();
  const double thickness = kOnPlane * extent;
  const ConvexPolygon front1 = clip_to_half_space(polygon1, polygon2.front(), normal2, thickness);
  if (front1.empty()) return 0;
  const ConvexPolygon front2 = clip_to_half_space(polygon2, polygon1.front(), normal1, thickness);
  if (front2.empty()) return 0;

  // In the smaller one, whose corners would lose digits far from the origin.
  const Vec3 origin = size1 <= size2 ? polygon1.front() : polygon2.front();
  const double scale = 1 / extent;
  const FacingPair pair{moved_and_scaled(front1, origin, scale),
                        moved_and_scaled(front2, origin, scale), normal1, normal2};
  return facing_exchange_area(pair, tolerance) * extent * extent;
}

/// Convex pieces that fit a ConvexPolygon: the polygon itself, or a fan of triangles.
std::vector<std::array<Vec3, 3>> fan(std::span<const Vec3> polygon) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  }
  return triangles;
}

}  // namespace

double exchange_area(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2,
                     double tolerance) {
  constexpr std::size_t kLargest = ConvexPolygon::kCapacity - 2;
  if (polygon1.size() > kLargest) {
    double sum = 0;
    for (const auto& triangle : fan(polygon1)) sum += exchange_area(triangle, polygon2, tolerance);
    return sum;
  }
  if (polygon2.size() > kLargest) return exchange_area(polygon2, polygon1, tolerance);
  return convex_exchange_area(polygon1, polygon2, tolerance);
}

}  // namespace radiosity
