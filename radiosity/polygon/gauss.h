#pragma once

#include <span>

namespace radiosity {

/// A point and weight of a rule on [0, 1].
struct GaussPoint {
  double x;
  double weight;
};

inline constexpr int kMaxGaussOrder = 32;

/// Gauss-Legendre rule with n points for ∫₀¹ f(x) dx, 1 <= n <= kMaxGaussOrder. Exact for
/// polynomials of degree 2n - 1.
std::span<const GaussPoint> gauss_rule(int n);

/// Gauss-Jacobi rule with n points for ∫₀¹ f(x) x dx, 1 <= n <= kMaxGaussOrder: the radial rule of
/// a triangle with its corner at x = 0. Exact for polynomials f of degree 2n - 1.
std::span<const GaussPoint> gauss_jacobi_rule(int n);

}  // namespace radiosity
