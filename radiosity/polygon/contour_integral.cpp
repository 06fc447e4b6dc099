#include "radiosity/polygon/contour_integral.h"

#include <array>
#include <cmath>
#include <limits>

#include "radiosity/polygon/gauss.h"

namespace radiosity {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Roundings of this size add up in quadrature; a few epsilon leave room for unlucky cases.
constexpr double kRounding = 4 * kEpsilon;
/// Edges at a smaller angle than this (radian) count as parallel.
constexpr double kParallel = 1e-14;
/// At smaller angles than this the closed form for skew edges loses its digits: the feet of the
/// common perpendicular are known to a rounding over the angle squared. Edges that were parallel
/// before a file rounded them are such. The error of quadrature then, relative to the lengths.
constexpr double kNearlyParallel = 1e-4;
constexpr double kNearlyParallelError = 1e-11;
/// Lines closer than this (of order-1 coordinates) count as intersecting.
constexpr double kIntersecting = 1e-13;

double square_of(double x) { return x * x; }

struct Edge {
  std::array<Vec3, 2> ends;
  Vec3 direction;
  double length;
};

Edge make_edge(std::span<const Vec3> polygon, std::size_t k) {
  const Vec3& a = polygon[k];
  const Vec3& b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
  const Vec3 way = b - a;
  const double length = way.norm();
  return {{a, b}, length > 0 ? Vec3(way / length) : Vec3(Vec3::Zero()), length};
}

/// Which ends of two edges are closest to each other.
std::array<int, 2> nearest_ends(const Edge& e1, const Edge& e2) {
  std::array<int, 2> nearest{0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      const double square = (e1.ends[i] - e2.ends[j]).squaredNorm();
      if (square < least) {
        least = square;
        nearest = {i, j};
      }
    }
  }
  return nearest;
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
  const Vec3 way = e1.ends[0] - e2.ends[0];
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
      sum.error += square_of(term);
    }
  }
  return {sum.value, kRounding * std::sqrt(sum.error)};
}

/// An angle with what the dilogarithm needs of it.
struct Angle {
  double value;  ///< radian, in (0, π)
  double sine;
  double one_minus_cosine;
};

/// Im Li₂(u) = Im Σ B_n uⁿ⁺¹ / (n+1)! with u = -ln(1 - z), for z in the unit disk with Re z <= ½.
double dilogarithm_series(double re, double im) {
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
  const double square_re = re * re - im * im;
  const double square_im = 2 * re * im;
  double sum_re = 0;
  double sum_im = 0;
  for (std::size_t k = kBernoulli.size(); k-- > 0;) {
    const double next = (sum_re + kBernoulli[k]) * square_re - sum_im * square_im;
    sum_im = (sum_re + kBernoulli[k]) * square_im + sum_im * square_re;
    sum_re = next;
  }
  const double factor_re = 1 + sum_re - 0.25 * re;
  const double factor_im = sum_im - 0.25 * im;
  return re * factor_im + im * factor_re;
}

/// Im Li₂(e^{-x + iα}) for x >= 0 with decay = e^{-x}: the series, or for Re z > ½ the reflection
/// Li₂(z) = π²/6 - ln z ln(1 - z) - Li₂(1 - z). ('t Hooft & Veltman 1979, appendix A)
double imaginary_dilogarithm(double x, double decay, const Angle& alpha) {
  const double one_minus_decay = x < 0.5 ? -std::expm1(-x) : 1 - decay;
  const double re = one_minus_decay + decay * alpha.one_minus_cosine;  // of 1 - z
  const double im = -decay * alpha.sine;
  const double norm = re * re + im * im;
  if (norm == 0) return 0;
  const double log_re = 0.5 * std::log(norm);
  const double log_im = std::atan2(im, re);
  if (re >= 0.5) return dilogarithm_series(-log_re, -log_im);
  const double product = -x * log_im + alpha.value * log_re;  // Im(ln z ln(1 - z))
  return -product - dilogarithm_series(x, -alpha.value);
}

/// ∫ atan(tanh(x/2) cot(a/2)) dx, even in x; `growth` is e^x.
double angle_antiderivative(double x, double growth, const Angle& a) {
  if (x < 0) {
    x = -x;
  } else {
    growth = 1 / growth;
  }
  return 0.5 * (kPi - a.value) * x + imaginary_dilogarithm(x, growth, a);
}

/// h² ∬ ds dt / (s² + t² - 2 s t cos α + h²) over the rectangle s × t.
Estimate skew_part(const std::array<double, 2>& s, const std::array<double, 2>& t, double h,
                   double cosine, double sine) {
  const Angle alpha{std::atan2(sine, cosine), sine, 1 - cosine};
  const Angle supplement{kPi - alpha.value, sine, 1 + cosine};
  const double k = h / sine;
  std::array<double, 2> p;
  std::array<double, 2> q;
  std::array<double, 2> growth_p;  // e^p = s/k + sqrt(1 + (s/k)²), and its inverse for s < 0
  std::array<double, 2> growth_q;
  const auto substitute = [k](double length, double& exponent, double& growth) {
    exponent = std::asinh(length / k);
    growth = std::exp(exponent);
  };
  for (const int i : {0, 1}) {
    substitute(s[i], p[i], growth_p[i]);
    substitute(t[i], q[i], growth_q[i]);
  }
  Estimate sum;
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      const double plus = angle_antiderivative(p[i] + q[j], growth_p[i] * growth_q[j], supplement);
      const double minus = angle_antiderivative(p[i] - q[j], growth_p[i] / growth_q[j], alpha);
      sum.value += (i == j ? 1 : -1) * (plus - minus);
      sum.error += square_of(plus) + square_of(minus);
    }
  }
  const double factor = h * h / sine;
  return {factor * sum.value, kRounding * factor * std::sqrt(sum.error)};
}

/// Euler's theorem for the homogeneous ln r turns ∬ ln r ds dt into boundary terms and h² K, with
/// s, t measured from the feet of the common perpendicular of length h.
Estimate skew_edges(const Edge& e1, const Edge& e2, double c, const Vec3& cross, double sine) {
  // Feet are found from the nearest ends: their rounding is that distance's, over the sine squared.
  const auto [end1, end2] = nearest_ends(e1, e2);
  const Vec3 way = e1.ends[end1] - e2.ends[end2];
  const double a = way.dot(e1.direction);
  const double b = way.dot(e2.direction);
  const double foot1 = (c * b - a) / (sine * sine);
  const double foot2 = (b - c * a) / (sine * sine);
  const std::array s{-end1 * e1.length - foot1, (1 - end1) * e1.length - foot1};
  const std::array t{-end2 * e2.length - foot2, (1 - end2) * e2.length - foot2};
  const double h = std::abs(way.dot(cross)) / sine;

  Estimate sum;
  const auto add_boundary = [&](double fixed, const std::array<double, 2>& range, double sign) {
    const double d = std::sqrt(fixed * fixed * sine * sine + h * h);
    const double upper = log_antiderivative(range[1] - c * fixed, d);
    const double lower = log_antiderivative(range[0] - c * fixed, d);
    sum.value += sign * fixed * (upper - lower);
    // Terms round, and the feet are known to a rounding divided by the sine.
    const double feet = (std::abs(fixed) + std::abs(range[0]) + std::abs(range[1])) / sine;
    sum.error += square_of(fixed) * (square_of(upper) + square_of(lower)) + square_of(fixed * feet);
  };
  add_boundary(s[1], t, 1);
  add_boundary(s[0], t, -1);
  add_boundary(t[1], s, 1);
  add_boundary(t[0], s, -1);
  sum.error = kRounding * std::sqrt(sum.error);
  if (h > kIntersecting) {
    const Estimate skew = skew_part(s, t, h, c, sine);
    sum.value += skew.value;
    sum.error += skew.error;
  }
  return {0.5 * sum.value, 0.5 * sum.error};
}

/// ∫ over e2 of ln r for the point at s on e1.
double inner_integral(const Edge& e1, const Edge& e2, double s) {
  const Vec3 way = e1.ends[0] + s * e1.direction - e2.ends[0];
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

/// The same by quadrature along e1.
Estimate integrate_adaptively(const Edge& e1, const Edge& e2, double tolerance) {
  const double whole = gauss_interval(e1, e2, 0, e1.length);
  Estimate result = adaptive_interval(e1, e2, 0, e1.length, whole, tolerance, kAdaptiveDepth);
  result.value += 0.5 * e1.length * e2.length;  // to leave out the same term as elsewhere
  return result;
}

Estimate edge_pair(const Edge& e1, const Edge& e2, double c) {
  const Vec3 cross = e1.direction.cross(e2.direction);
  const double sine = cross.norm();
  if (sine < kParallel) return parallel_edges(e1, e2, c);
  if (sine < kNearlyParallel) {
    return integrate_adaptively(e1, e2, kNearlyParallelError * e1.length * e2.length);
  }
  return skew_edges(e1, e2, c, cross, sine);
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
      sum.error += square_of(c) * (square_of(term.error) + square_of(kEpsilon * term.value));
    }
  }
  return {sum.value / (2 * kPi), std::sqrt(sum.error) / (2 * kPi)};
}

}  // namespace

double imaginary_dilogarithm(double x, double alpha) {
  const double half = std::sin(0.5 * alpha);
  return imaginary_dilogarithm(x, std::exp(-x), {alpha, std::sin(alpha), 2 * half * half});
}

Estimate contour_exchange_area(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2) {
  return sum_over_edges(polygon1, polygon2, edge_pair);
}

Estimate contour_exchange_area_adaptive(std::span<const Vec3> polygon1,
                                        std::span<const Vec3> polygon2, double tolerance) {
  const double per_pair =
      tolerance / static_cast<double>(polygon1.size() * polygon2.size()) * 2 * kPi;
  return sum_over_edges(polygon1, polygon2,
                        [per_pair](const Edge& e1, const Edge& e2, double) -> Estimate {
                          return integrate_adaptively(e1, e2, per_pair);
                        });
}

}  // namespace radiosity
