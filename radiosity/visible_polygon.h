#pragma once

#include <span>

#include "radiosity/convex_polygon.h"
#include "radiosity/occluders.h"

namespace radiosity {

/// Form factor from a surface element at `point` with unit `normal` to the part of `target` that no
/// occluder hides, by cutting the occluders' shadows out of the target: exact up to rounding. The
/// target lies in front of the element and faces it. Occluders within `thickness` (m) of the
/// point's own place are passed over. (Weiler & Atherton 1977; Lambert's formula for the parts)
double visible_point_to_polygon(const Vec3& point, const Vec3& normal, const ConvexPolygon& target,
                                std::span<const Occluder* const> occluders, double thickness);

}  // namespace radiosity
