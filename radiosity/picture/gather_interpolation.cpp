#include "radiosity/picture/gather_interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {
namespace {

/// Interpolations along both directions: the error of the first, and that of the second as the
/// first one magnifies it at most (the Lebesgue constant of six nodes is 2.1).
constexpr double kDirections = 3.1;

double chebyshev_node(int k, int order) { return std::cos(kPi * (k + 0.5) / order); }

using Basis = std::array<double, RectangleInterpolation::kLargestOrder>;

/// Lagrange's polynomials on the nodes.
Basis lagrange(double x, int order) {
  Basis values{};
  for (int k = 0; k < order; ++k) {
    values[k] = 1;
    const double node = chebyshev_node(k, order);
    for (int other = 0; other < order; ++other) {
      if (other == k) continue;
      const double there = chebyshev_node(other, order);
      values[k] *= (x - there) / (node - there);
    }
  }
  return values;
}

/// Bound on the relative error for (1 - x/r)⁻⁴ on [-1, 1]: with n nodes its n-th derivative divided
/// by n! 2^(n-1).
double remainder(int n, double r) {
  if (r <= 1) return std::numeric_limits<double>::infinity();
  const double binomial = (n + 3.0) * (n + 2.0) * (n + 1.0) / 6;
  return binomial * std::pow(r, -n) * std::pow(1 - 1 / r, -n - 4) * std::pow(2.0, 1 - n);
}

}  // namespace

Rectangle bounding_rectangle(std::span<const Vec3> polygon, const Vec3& normal) {
  Rectangle best{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 edge = polygon[k + 1 < polygon.size() ? k + 1 : 0] - polygon[k];
    if (edge.squaredNorm() == 0) continue;
    const Vec3 u = edge.normalized();
    const Vec3 v = normal.cross(u);
    Eigen::AlignedBox2d box;
    for (const Vec3& corner : polygon) {
      const Vec3 way = corner - polygon[k];
      box.extend(Eigen::Vector2d(u.dot(way), v.dot(way)));
    }
    const double area = box.volume();
    if (area >= least) continue;
    least = area;
    const Eigen::Vector2d middle = box.center();
    best = {polygon[k] + middle[0] * u + middle[1] * v, 0.5 * box.sizes()[0] * u,
            0.5 * box.sizes()[1] * v};
  }
  return best;
}

RectangleInterpolation::RectangleInterpolation(const Rectangle& rectangle, int order)
    : rectangle_(rectangle), order_(order) {}

Vec3 RectangleInterpolation::node(int k) const {
  return rectangle_.center + chebyshev_node(k % order_, order_) * rectangle_.half_u +
         chebyshev_node(k / order_, order_) * rectangle_.half_v;
}

std::array<double, RectangleInterpolation::kMostNodes> RectangleInterpolation::weights(
    const Vec3& point) const {
  const Vec3 way = point - rectangle_.center;
  const auto place = [&](const Vec3& half) {
    const double square = half.squaredNorm();
    return square > 0 ? std::clamp(way.dot(half) / square, -1.0, 1.0) : 0.0;
  };
  const Basis u = lagrange(place(rectangle_.half_u), order_);
  const Basis v = lagrange(place(rectangle_.half_v), order_);
  std::array<double, kMostNodes> result;
  for (int k = 0; k < n_nodes(); ++k) result[k] = u[k % order_] * v[k / order_];
  return result;
}

int RectangleInterpolation::least_order(double distance_ratio, double tolerance) {
  for (int order = 2; order <= kLargestOrder; ++order) {
    if (kDirections * remainder(order, distance_ratio) <= tolerance) return order;
  }
  return 0;
}

}  // namespace radiosity
