#pragma once

#include <vector>

#include "radiosity/polygon/convex_hull.h"

namespace radiosity {

/// Whether two of these convex, counter-clockwise polygons in a plane overlap by more than their
/// borders: what reaches less than `thickness` (m) beyond an edge of the other doesn't.
bool has_overlap(const std::vector<std::vector<Point2>>& polygons, double thickness);

}  // namespace radiosity
