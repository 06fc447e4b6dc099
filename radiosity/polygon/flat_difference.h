#pragma once

#include <vector>

#include "radiosity/polygon/convex_hull.h"

namespace radiosity {

/// A convex polygon in a plane, counter-clockwise.
using FlatPolygon = std::vector<Point2>;

/// Its area; negative if it runs clockwise.
double flat_area(const FlatPolygon& polygon);

/// Whether the point is in the polygon, or no further than `margin` beyond one of its edges' lines.
bool holds(const FlatPolygon& polygon, const Point2& point, double margin);

/// Takes a convex polygon away from convex parts that do not overlap; what is left of each is
/// divided along lines through the polygon's edges. Corners within `margin` of such a line count as
/// on it. (Sutherland & Hodgman 1974, one edge at a time)
void subtract(const FlatPolygon& polygon, double margin, std::vector<FlatPolygon>& parts);

}  // namespace radiosity
