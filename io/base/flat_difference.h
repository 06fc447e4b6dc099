#pragma once

#include <span>
#include <vector>

#include "radiosity/polygon/convex_polygon.h"

namespace io {

/// What is left of a convex polygon where convex holes are cut out of it, as convex pieces: each
/// edge of a hole that is met cuts off what lies beyond its line. All run counter-clockwise about
/// `normal`, of unit length, and lie in one plane. Corners within `thickness` (m) of a line count
/// as lying on it, so that no piece is thinner. A hole that does not reach into the polygon cuts
/// nothing; holes may overlap. Empty if nothing is left.
std::vector<radiosity::ConvexPolygon> flat_difference(
    const radiosity::ConvexPolygon& polygon, std::span<const radiosity::ConvexPolygon> holes,
    const radiosity::Vec3& normal, double thickness);

}  // namespace io
