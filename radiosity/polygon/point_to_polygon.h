#pragma once

#include <span>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Form factor from a surface element at `point` with unit `normal` to an unobstructed planar
/// polygon that faces it: the fraction of the power leaving the element that meets the polygon's
/// emitting side; 0 from behind. The polygon is clipped to the element's horizon.
/// F = 1/(2π) Σ_k θ_k n·Γ_k   (Lambert 1760; Cohen & Wallace 1993, eq. 4.13)
double point_to_polygon(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon);

/// The same for a polygon that wholly faces the element from above its horizon.
double facing_point_to_polygon(const Vec3& point, const Vec3& normal,
                               std::span<const Vec3> polygon);

}  // namespace radiosity
