#pragma once

#include <array>
#include <span>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/gauss.h"

namespace radiosity {

/// Calls visit(point, weight) for the points of a product Gauss rule of `order` points a direction
/// over a convex planar polygon; the weights sum to its area, m². Quads take the bilinear map,
/// triangles the one collapsed at a corner, others a fan of triangles.
template <typename Visit>
void for_each_quadrature_point(std::span<const Vec3> polygon, int order, const Visit& visit) {
  if (polygon.size() == 4) {
    const Vec3 &a = polygon[0], &b = polygon[1], &c = polygon[2], &d = polygon[3];
    for (const GaussPoint& u : gauss_rule(order)) {
      const Vec3 low = a + u.x * (b - a);
      const Vec3 high = d + u.x * (c - d);
      for (const GaussPoint& v : gauss_rule(order)) {
        const Vec3 along_u = (1 - v.x) * (b - a) + v.x * (c - d);
        const double jacobian = along_u.cross(high - low).norm();
        visit(Vec3(low + v.x * (high - low)), u.weight * v.weight * jacobian);
      }
    }
    return;
  }
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 first = polygon[k - 1] - polygon[0];
    const Vec3 second = polygon[k] - polygon[0];
    const double jacobian = first.cross(second).norm();
    for (const GaussPoint& u : gauss_jacobi_rule(order)) {
      for (const GaussPoint& v : gauss_rule(order)) {
        visit(Vec3(polygon[0] + u.x * (first + v.x * (second - first))),
              u.weight * v.weight * jacobian);
      }
    }
  }
}

/// Points a direction that a product Gauss rule needs on a polygon of radius r for the relative
/// error `tolerance`, if the nearest point of the other polygon is `distance_ratio` x r away from
/// its centre; 0 if no rule of at most kLargestAreaRule points does.
int area_rule_order(double distance_ratio, double tolerance);

/// The least distance_ratio for which a rule of `order` >= 2 points a direction does.
double area_rule_least_ratio(int order, double tolerance);

inline constexpr int kLargestAreaRule = 6;

/// Points of a product rule, in groups of four for vector units.
constexpr int padded_points(int order) { return (order * order + 3) / 4 * 4; }

/// Points of a rule on one polygon, their weights times r cosθ at the other: polygons are planar,
/// so that the latter depends on this polygon's point alone. The last group is padded by weight 0.
struct WeightedPoints {
  static constexpr int kMost = padded_points(kLargestAreaRule);
  const double* x = nullptr;  ///< coordinates, here or in `own`, m
  const double* y = nullptr;
  const double* z = nullptr;
  std::array<double, kMost> weight;

  /// Makes the points of a rule on `polygon` against the plane normal · x = offset of the other.
  void make(std::span<const Vec3> polygon, int order, const Vec3& normal, double offset);
  /// Turns a rule's weights into those of points that x, y and z refer to already.
  void weigh(const double* rule_weight, int n_points, const Vec3& normal, double offset);

 private:
  std::array<double, 3 * kMost> own_;
};

/// 1/π Σ_a Σ_b w_a w_b / r⁴ over the first n_a and n_b points, n_b a multiple of four. Compiled for
/// several instruction sets, of which the machine's best runs.
double sum_over_points(const WeightedPoints& a, int n_a, const WeightedPoints& b, int n_b);

/// Exchange area of two polygons that wholly face each other, by product Gauss rules on both, m².
/// At most four corners and orders up to kLargestAreaRule, else in pieces.
double area_rule_exchange_area(std::span<const Vec3> polygon1, const Vec3& normal1, int order1,
                               std::span<const Vec3> polygon2, const Vec3& normal2, int order2);

}  // namespace radiosity
