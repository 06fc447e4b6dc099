#pragma once

#include <cmath>
#include <span>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/gauss.h"

namespace radiosity {

/// An integral over directions, and what its last refinement changed, which is more than it is off.
struct SphericalIntegral {
  double value = 0;
  double error = 0;

  SphericalIntegral& operator+=(const SphericalIntegral& other) {
    value += other.value;
    error += other.error;
    return *this;
  }
};

namespace detail {

inline constexpr int kCoarseRule = 3;  ///< points a direction, of triangles
inline constexpr int kFineRule = 5;
/// Triangles smaller than this, sr, may be off by as much as one of this size.
inline constexpr double kSmallTriangle = 1e-4;
/// Halvings of edges, which then are below 1e-7 rad.
inline constexpr int kMostHalvings = 24;

/// A rule with that many points a direction on the flat triangle; dω = a·(b×c) / r³ ds dt. Also
/// the solid angle, sr.
template <typename F>
double over_flat_triangle(const Vec3& a, const Vec3& b, const Vec3& c, int n, const F& f,
                          double* solid_angle) {
  const double volume = a.dot(b.cross(c));
  const Vec3 first = b - a;
  const Vec3 across = c - b;
  double sum = 0;
  *solid_angle = 0;
  for (const GaussPoint& u : gauss_jacobi_rule(n)) {
    for (const GaussPoint& v : gauss_rule(n)) {
      const Vec3 x = a + u.x * (first + v.x * across);
      const double square = x.squaredNorm();
      const double r = std::sqrt(square);
      const double weight = u.weight * v.weight * volume / (square * r);
      sum += weight * f(Vec3(x / r));
      *solid_angle += weight;
    }
  }
  return sum;
}

template <typename F>
void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double allowed, int halvings,
                  const F& f, SphericalIntegral& sum) {
  double solid_angle = 0;
  const double coarse = over_flat_triangle(a, b, c, kCoarseRule, f, &solid_angle);
  const double fine = over_flat_triangle(a, b, c, kFineRule, f, &solid_angle);
  const double change = std::abs(fine - coarse);
  if (change <= allowed * std::max(solid_angle, kSmallTriangle) || halvings >= kMostHalvings) {
    sum += {fine, change};
    return;
  }
  const Vec3 ab = (a + b).normalized();
  const Vec3 bc = (b + c).normalized();
  const Vec3 ca = (c + a).normalized();
  add_triangle(a, ab, ca, allowed, halvings + 1, f, sum);
  add_triangle(ab, b, bc, allowed, halvings + 1, f, sum);
  add_triangle(ca, bc, c, allowed, halvings + 1, f, sum);
  add_triangle(ab, bc, ca, allowed, halvings + 1, f, sum);
}

}  // namespace detail

/// ∫ f(ω) dω over the directions in which the origin sees a convex planar polygon, whose corners
/// run counter-clockwise as seen from behind it and need not be of one distance. Triangles are
/// divided in four until Gauss rules of 3 and 5 points a direction differ by `allowed` per sr at
/// most; the latter counts. f takes unit vectors.
template <typename F>
SphericalIntegral spherical_integral(std::span<const Vec3> polygon, double allowed, const F& f) {
  SphericalIntegral sum;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    // Slivers that cutting leaves may run the other way round, of nothing but rounding.
    if (!(polygon[0].dot(polygon[k - 1].cross(polygon[k])) > 0)) continue;
    detail::add_triangle(polygon[0].normalized(), polygon[k - 1].normalized(),
                         polygon[k].normalized(), allowed, 0, f, sum);
  }
  return sum;
}

}  // namespace radiosity
