#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// The polygons of a scene with equal positions made one vertex: polygons that touch in the scene
/// share vertex indices here, whatever indices the file used.
struct WeldedPolygons {
  std::vector<radiosity::Vec3> vertices;      ///< distinct positions that polygons use, m
  std::vector<std::int32_t> corners;          ///< vertex indices of all polygons, concatenated
  std::vector<std::int64_t> first_corner{0};  ///< n_polygons + 1 offsets into `corners`

  [[nodiscard]] radiosity::Index size() const {
    return static_cast<radiosity::Index>(first_corner.size()) - 1;
  }
  [[nodiscard]] std::span<const std::int32_t> polygon(radiosity::Index i) const {
    return std::span(corners).subspan(first_corner[i], first_corner[i + 1] - first_corner[i]);
  }
};

/// Welds exactly equal positions (no tolerance; -0 equals 0) and drops corners that repeat the one
/// before them, so a polygon may end up with fewer than three. Vertices keep the scene's order.
WeldedPolygons weld(const radiosity::Scene& scene);

/// The same, but a position that is within `tolerance` (m) of an earlier one in each coordinate is
/// taken for that: of several, for the earliest.
WeldedPolygons weld(const radiosity::Scene& scene, double tolerance);

}  // namespace meshing
