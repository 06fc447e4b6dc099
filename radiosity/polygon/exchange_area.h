#pragma once

#include <span>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Exchange area G_12 = A_1 F_12 of two convex planar polygons that see each other without
/// obstruction, m². Symmetric. Each polygon is counter-clockwise about its emitting normal; parts
/// behind the other's plane are clipped away (exactly 0 if nothing is left). Polygons may touch at
/// edges and vertices.
/// G_12 = ∫_A1 ∫_A2 cosθ_1 cosθ_2 / (π r²) dA_2 dA_1   (Cohen & Wallace 1993, eq. 4.8)
/// `tolerance` is the relative error aimed at; 1e-11 is about what double precision gives.
double exchange_area(std::span<const Vec3> polygon1, std::span<const Vec3> polygon2,
                     double tolerance = 1e-11);

}  // namespace radiosity
