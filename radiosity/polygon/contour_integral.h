#pragma once

#include <span>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// A value with a bound on its rounding error.
struct Estimate {
  double value = 0;
  double error = 0;
};

/// Exchange area of two planar polygons that wholly face each other without obstruction, by the
/// double contour integral in closed form:
///     2π G_12 = Σ_edges (u·v) ∬ ln r ds dt
/// with unit edge directions u, v (Sparrow 1963; closed forms: Schröder & Hanrahan 1993). Exact up
/// to rounding, also for polygons that touch at edges or vertices. Rounding grows with distance:
/// use area rules from a few diameters on. Coordinates should be of order 1.
Estimate contour_exchange_area(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2);

/// The same with the inner integral in closed form (Mitalas & Stephenson 1966) and the outer one by
/// adaptive Gauss quadrature to the absolute error `tolerance`. Slow; robust for nearly parallel
/// edges, where the closed form cancels.
Estimate contour_exchange_area_adaptive(std::span<const Vec3> polygon1,
                                        std::span<const Vec3> polygon2, double tolerance);

/// Imaginary part of the dilogarithm Li₂(e^{-x + iα}), x >= 0, 0 < α < π.
double imaginary_dilogarithm(double x, double alpha);

}  // namespace radiosity
