#include "radiosity/polygon/polygon_quadrature.h"

#include <array>
#include <cmath>

namespace radiosity {

double area_rule_least_ratio(int order, double tolerance) {
  // A Gauss rule of n points converges like ϱ^-2n for an integrand analytic within the Bernstein
  // ellipse of parameter ϱ; the kernel's nearest singularity lies at distance_ratio half-lengths.
  // Grazing pairs, whose cosines nearly vanish, lose one power of ϱ: over random pairs the largest
  // relative error is 1 to 3 times ϱ^-(2n-1), for every n and ϱ.
  const double rho = std::pow(4 / tolerance, 1.0 / (2 * order - 1));
  return 0.5 * (rho + 1 / rho);
}

int area_rule_order(double distance_ratio, double tolerance) {
  if (distance_ratio <= 1) return 0;
  const double rho = distance_ratio + std::sqrt(distance_ratio * distance_ratio - 1);
  double error = 4 / rho;
  for (int order = 2; order <= kLargestAreaRule; ++order) {  // one point would miss the cosines
    error /= rho * rho;
    if (error <= tolerance) return order;
  }
  return 0;
}

void WeightedPoints::make(std::span<const Vec3> polygon, int order, const Vec3& normal,
                          double offset) {
  const int n_points = padded_points(order);
  std::array<double, kMost> rule_weight;
  int n = 0;
  const auto add = [&](const Vec3& point, double point_weight) {
    own_[n] = point.x();
    own_[kMost + n] = point.y();
    own_[2 * kMost + n] = point.z();
    rule_weight[n++] = point_weight;
  };
  for_each_quadrature_point(polygon, order, add);
  while (n < n_points) add(polygon.front(), 0);
  x = own_.data();
  y = x + kMost;
  z = y + kMost;
  weigh(rule_weight.data(), n_points, normal, offset);
}

void WeightedPoints::weigh(const double* rule_weight, int n_points, const Vec3& normal,
                           double offset) {
  for (int k = 0; k < n_points; ++k) {
    weight[k] =
        rule_weight[k] * (normal.x() * x[k] + normal.y() * y[k] + normal.z() * z[k] - offset);
  }
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) double sum_over_points(
    const WeightedPoints& a, int n_a, const WeightedPoints& b, int n_b) {
  double total = 0;
  for (int i = 0; i < n_a; i += 2) {
    // Two points of `a` share a division, which costs more than all the rest. An odd last one goes
    // with itself, at no weight.
    const int k = i + 1 < n_a ? i + 1 : i;
    const double weight_i = a.weight[i];
    const double weight_k = k > i ? a.weight[k] : 0;
    double lanes[4] = {0, 0, 0, 0};
    for (int j = 0; j < n_b; j += 4) {
      for (int lane = 0; lane < 4; ++lane) {
        const double x = b.x[j + lane];
        const double y = b.y[j + lane];
        const double z = b.z[j + lane];
        const double square_i =
            (x - a.x[i]) * (x - a.x[i]) + (y - a.y[i]) * (y - a.y[i]) + (z - a.z[i]) * (z - a.z[i]);
        const double square_k =
            (x - a.x[k]) * (x - a.x[k]) + (y - a.y[k]) * (y - a.y[k]) + (z - a.z[k]) * (z - a.z[k]);
        const double fourth_i = square_i * square_i;
        const double fourth_k = square_k * square_k;
        lanes[lane] += b.weight[j + lane] * (weight_i * fourth_k + weight_k * fourth_i) /
                       (fourth_i * fourth_k);
      }
    }
    total += (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
  }
  return total / kPi;
}

double area_rule_exchange_area(std::span<const Vec3> polygon1, const Vec3& normal1, int order1,
                               std::span<const Vec3> polygon2, const Vec3& normal2, int order2) {
  // Polygons with more corners than a quad go as the triangles of a fan.
  const auto fan_size = [](std::span<const Vec3> polygon) {
    return polygon.size() <= 4 ? std::size_t{1} : polygon.size() - 2;
  };
  const auto piece = [](std::span<const Vec3> polygon, std::size_t k,
                        std::array<Vec3, 3>& triangle) {
    if (polygon.size() <= 4) return polygon;
    triangle = {polygon[0], polygon[k + 1], polygon[k + 2]};
    return std::span<const Vec3>(triangle);
  };
  double sum = 0;
  WeightedPoints points1;
  WeightedPoints points2;
  std::array<Vec3, 3> triangle;
  for (std::size_t k = 0; k < fan_size(polygon1); ++k) {
    points1.make(piece(polygon1, k, triangle), order1, normal2, normal2.dot(polygon2.front()));
    for (std::size_t m = 0; m < fan_size(polygon2); ++m) {
      points2.make(piece(polygon2, m, triangle), order2, normal1, normal1.dot(polygon1.front()));
      sum += sum_over_points(points1, order1 * order1, points2, padded_points(order2));
    }
  }
  return sum;
}

}  // namespace radiosity
