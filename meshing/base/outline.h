#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshing/base/polygon_shape.h"
#include "radiosity/base/geometry.h"

namespace meshing {

/// The corners of a polygon from the smallest vertex index on, forwards or backwards, whichever is
/// smaller: equal for polygons with the same outline.
struct Outline {
  std::vector<std::int32_t> corners;
  bool reversed = false;
};

Outline outline(std::span<const std::int32_t> polygon);

/// Whether the outline of a polygon of this kind crosses itself, seen along its normal; false for
/// one of zero area. `points` are without repeated consecutive corners.
bool has_crossing_outline(PolygonKind kind, std::span<const radiosity::Vec3> points);

}  // namespace meshing
