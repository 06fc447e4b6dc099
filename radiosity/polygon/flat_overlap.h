#pragma once

#include <vector>

#include "radiosity/polygon/convex_hull.h"

namespace radiosity {

/// Whether two of these convex, counter-clockwise polygons in a plane overlap by more than their
/// borders: what reaches less than `thickness` (m) beyond an edge of the other doesn't.
bool has_overlap(const std::vector<std::vector<Point2>>& polygons, double thickness);

/// Whether these convex, counter-clockwise polygons leave a gap within a convex one, `hull`, whose
/// corners are of theirs: one as wide as `width`, m, and not only between edges that rounding has
/// moved apart. A gap is a polygon itself, with corners of theirs, at one of which it is 60 degrees
/// wide; so points are tried all around each corner.
bool has_gap(const std::vector<std::vector<Point2>>& polygons, const std::vector<Point2>& hull,
             double width);

}  // namespace radiosity
