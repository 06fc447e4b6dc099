#include "radiosity/polygon_quadrature.h"

#include <array>
#include <cmath>

namespace radiosity {

int area_rule_order(double distance_ratio, double tolerance) {
  // A Gauss rule of n points converges like ϱ^-2n for an integrand analytic within the Bernstein
  // ellipse of parameter ϱ; the kernel's nearest singularity lies at distance_ratio half-lengths.
  // Grazing pairs, whose cosines nearly vanish, lose one power of ϱ: over random pairs the largest
  // relative error is 1 to 3 times ϱ^-(2n-1), for every n and ϱ.
  if (distance_ratio <= 1) return 0;
  const double rho = distance_ratio + std::sqrt(distance_ratio * distance_ratio - 1);
  double error = 4 / rho;
  for (int order = 2; order <= kLargestAreaRule; ++order) {  // one point would miss the cosines
    error /= rho * rho;
    if (error <= tolerance) return order;
  }
  return 0;
}

double area_rule_exchange_area(std::span<const Vec3> polygon1, const Vec3& normal1, int order1,
                               std::span<const Vec3> polygon2, const Vec3& normal2, int order2) {
  double sum = 0;
  for_each_quadrature_point(polygon1, order1, [&](const Vec3& x, double weight1) {
    for_each_quadrature_point(polygon2, order2, [&](const Vec3& y, double weight2) {
      const Vec3 way = y - x;
      const double square = way.squaredNorm();
      sum -= weight1 * weight2 * normal1.dot(way) * normal2.dot(way) / (square * square);
    });
  });
  return sum / kPi;
}

}  // namespace radiosity
