#include "radiosity/contour_integral.h"

#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "radiosity/gauss.h"

namespace radiosity {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Edges at a smaller angle than this (radian) count as parallel.
constexpr double kParallel = 1e-14;
/// Lines closer than this (of order-1 coordinates) count as intersecting.
constexpr double kIntersecting = 1e-13;

struct Edge {
  Vec3 start;
  Vec3 direction;
  double length;
};

Edge make_edge(std::span<const Vec3> polygon, std::size_t k) {
  const Vec3& a = polygon[k];
  const Vec3 way = polygon[k + 1 < polygon.size() ? k + 1 : 0] - a;
  const double length = way.norm();
  return {a, length > 0 ? Vec3(way / length) : Vec3(Vec3::Zero()), length};
}

/// ∫ ½ ln(τ² + d²) dτ + τ. (The part linear in τ cancels over closed contours.)
double log_antiderivative(double tau, double d) {
  const double square = tau * tau + d * d;
  if (square == 0) return 0;
  return 0.5 * tau * std::log(square) + (d > 0 ? d * std::atan(tau / d) : 0.0);
}

/// Every ∬ ln r ds dt below leaves out the term -3/2 L_1 L_2, which cancels over closed contours
/// because Σ (u·v) L_1 L_2 = (Σ u L_1)·(Σ v L_2) = 0.
Estimate parallel_edges(const Edge& e1, const Edge& e2, double c) {
  const Vec3 way = e1.start - e2.start;
  const double along = way.dot(e2.direction);
  const double d = (way - along * e2.direction).norm();
  const double sign = c > 0 ? 1 : -1;
  const auto second_antiderivative = [d](double x) {  // of ½ ln(x² + d²), without -¾ x²
    const double square = x * x + d * d;
    if (square == 0) return 0.0;
    return 0.25 * (x * x - d * d) * std::log(square) + (d > 0 ? d * x * std::atan(x / d) : 0.0);
  };
  Estimate sum;
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      // Position along the common direction of e1's end i as seen from e2's end j.
      const double x = along + sign * i * e1.length - j * e2.length;
      const double term = second_antiderivative(x);
      sum.value += (i == j ? -sign : sign) * term;
      sum.error += std::abs(term) + std::abs(x);
    }
  }
  return {sum.value, 4 * kEpsilon * sum.error};
}

/// ∫ atan(tanh(x/2) cot(a/2)) dx, even in x.
double angle_antiderivative(double x, double a) {
  x = std::abs(x);
  return 0.5 * (kPi - a) * x + imaginary_dilogarithm(x, a);
}

/// h² ∬ ds dt / (s² + t² - 2 s t cos α + h²) over the rectangle s × t.
Estimate skew_part(const std::array<double, 2>& s, const std::array<double, 2>& t, double h,
                   double alpha) {
  const double sine = std::sin(alpha);
  const double k = h / sine;
  const std::array p{std::asinh(s[0] / k), std::asinh(s[1] / k)};
  const std::array q{std::asinh(t[0] / k), std::asinh(t[1] / k)};
  Estimate sum;
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      const double plus = angle_antiderivative(p[i] + q[j], kPi - alpha);
      const double minus = angle_antiderivative(p[i] - q[j], alpha);
      sum.value += (i == j ? 1 : -1) * (plus - minus);
      sum.error += plus + minus;
    }
  }
  const double factor = h * h / sine;
  return {factor * sum.value, 4 * kEpsilon * factor * sum.error};
}

/// Euler's theorem for the homogeneous ln r turns ∬ ln r ds dt into boundary terms and h² K, with
/// s, t measured from the feet of the common perpendicular of length h.
Estimate skew_edges(const Edge& e1, const Edge& e2, double c, const Vec3& cross, double sine) {
  const Vec3 way = e1.start - e2.start;
  const double a = way.dot(e1.direction);
  const double b = way.dot(e2.direction);
  const double foot1 = (c * b - a) / (sine * sine);
  const double foot2 = (b - c * a) / (sine * sine);
  const std::array s{-foot1, e1.length - foot1};
  const std::array t{-foot2, e2.length - foot2};
  const double h = std::abs(way.dot(cross)) / sine;

  Estimate sum;
  const auto add_boundary = [&](double fixed, const std::array<double, 2>& range, double sign) {
    const double d = std::sqrt(fixed * fixed * sine * sine + h * h);
    const double upper = log_antiderivative(range[1] - c * fixed, d);
    const double lower = log_antiderivative(range[0] - c * fixed, d);
    sum.value += sign * fixed * (upper - lower);
    sum.error += std::abs(fixed) * (std::abs(upper) + std::abs(lower) + std::abs(fixed) +
                                    std::abs(range[0]) + std::abs(range[1]));
  };
  add_boundary(s[1], t, 1);
  add_boundary(s[0], t, -1);
  add_boundary(t[1], s, 1);
  add_boundary(t[0], s, -1);
  sum.error *= 4 * kEpsilon / sine;  // the feet are known to a rounding divided by the sine
  if (h > kIntersecting) {
    const Estimate skew = skew_part(s, t, h, std::atan2(sine, c));
    sum.value += skew.value;
    sum.error += skew.error;
  }
  return {0.5 * sum.value, 0.5 * sum.error};
}

Estimate edge_pair(const Edge& e1, const Edge& e2, double c) {
  const Vec3 cross = e1.direction.cross(e2.direction);
  const double sine = cross.norm();
  if (sine < kParallel) return parallel_edges(e1, e2, c);
  return skew_edges(e1, e2, c, cross, sine);
}

/// ∫ over e2 of ln r for the point at s on e1.
double inner_integral(const Edge& e1, const Edge& e2, double s) {
  const Vec3 way = e1.start + s * e1.direction - e2.start;
  const double along = way.dot(e2.direction);
  const double d = (way - along * e2.direction).norm();
  return log_antiderivative(e2.length - along, d) - log_antiderivative(-along, d);
}

constexpr int kAdaptiveOrder = 12;
constexpr int kAdaptiveDepth = 48;

double gauss_interval(const Edge& e1, const Edge& e2, double from, double to) {
  double sum = 0;
  for (const GaussPoint& point : gauss_rule(kAdaptiveOrder)) {
    sum += point.weight * inner_integral(e1, e2, from + point.x * (to - from));
  }
  return sum * (to - from);
}

Estimate adaptive_interval(const Edge& e1, const Edge& e2, double from, double to, double whole,
                           double tolerance, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss_interval(e1, e2, from, middle);
  const double right = gauss_interval(e1, e2, middle, to);
  const double difference = std::abs(left + right - whole);
  if (difference <= tolerance || depth == 0) return {left + right, difference};
  const Estimate a =
      adaptive_interval(e1, e2, from, middle, left, std::max(tolerance / 2, 1e-18), depth - 1);
  const Estimate b =
      adaptive_interval(e1, e2, middle, to, right, std::max(tolerance / 2, 1e-18), depth - 1);
  return {a.value + b.value, a.error + b.error};
}

template <typename PairIntegral>
Estimate sum_over_edges(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2,
                        const PairIntegral& pair_integral) {
  Estimate sum;
  for (std::size_t i = 0; i < polygon1.size(); ++i) {
    const Edge e1 = make_edge(polygon1, i);
    if (e1.length == 0) continue;
    for (std::size_t j = 0; j < polygon2.size(); ++j) {
      const Edge e2 = make_edge(polygon2, j);
      const double c = e1.direction.dot(e2.direction);
      if (c == 0 || e2.length == 0) continue;
      const Estimate term = pair_integral(e1, e2, c);
      sum.value += c * term.value;
      sum.error += std::abs(c) * (term.error + kEpsilon * std::abs(term.value));
    }
  }
  return {sum.value / (2 * kPi), sum.error / (2 * kPi)};
}

}  // namespace

double imaginary_dilogarithm(double x, double alpha) {
  using Complex = std::complex<double>;
  // Li₂(z) = Σ B_n uⁿ⁺¹ / (n+1)!, u = -ln(1 - z), for the half plane Re z <= ½ of the unit disk;
  // the rest by Li₂(z) = π²/6 - ln z ln(1 - z) - Li₂(1 - z). ('t Hooft & Veltman 1979, appendix A)
  static constexpr std::array kBernoulli{1.0 / 36,
                                         -1.0 / 3600,
                                         1.0 / 211680,
                                         -1.0 / 10886400,
                                         1.0 / 526901760,
                                         -4.0647616451442256e-11,
                                         8.9216910204564526e-13,
                                         -1.9939295860721076e-14,
                                         4.5189800296199182e-16,
                                         -1.0356517612182470e-17};
  const auto series = [](const Complex& u) {
    const Complex square = u * u;
    Complex sum = 0;
    for (std::size_t k = kBernoulli.size(); k-- > 0;) sum = (sum + kBernoulli[k]) * square;
    return u * (1.0 + sum - 0.25 * u);
  };
  const double decay = std::exp(-x);
  const double half_sine = std::sin(0.5 * alpha);
  const Complex one_minus_z(-std::expm1(-x) + 2 * decay * half_sine * half_sine,
                            -decay * std::sin(alpha));
  if (one_minus_z.real() >= 0.5) return series(-std::log(one_minus_z)).imag();
  const Complex log_z(-x, alpha);
  if (one_minus_z == Complex(0)) return 0;
  return -(log_z * std::log(one_minus_z) + series(-log_z)).imag();
}

Estimate contour_exchange_area(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2) {
  return sum_over_edges(polygon1, polygon2, edge_pair);
}

Estimate contour_exchange_area_adaptive(std::span<const Vec3> polygon1,
                                        std::span<const Vec3> polygon2, double tolerance) {
  const double per_pair =
      tolerance / static_cast<double>(polygon1.size() * polygon2.size()) * 2 * kPi;
  return sum_over_edges(
      polygon1, polygon2, [per_pair](const Edge& e1, const Edge& e2, double) -> Estimate {
        const double whole = gauss_interval(e1, e2, 0, e1.length);
        Estimate result = adaptive_interval(e1, e2, 0, e1.length, whole, per_pair, kAdaptiveDepth);
        result.value += 0.5 * e1.length * e2.length;  // to leave out the same term as elsewhere
        return result;
      });
}

}  // namespace radiosity
