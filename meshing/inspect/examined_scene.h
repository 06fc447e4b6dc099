#pragma once

#include <vector>

#include "meshing/base/edge_table.h"
#include "meshing/base/polygon_shape.h"
#include "meshing/base/weld.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// A scene with what all examinations need of it. Polygons keep their numbers.
struct ExaminedScene {
  const radiosity::Scene& scene;
  WeldedPolygons polygons;
  EdgeTable edges;
  std::vector<PolygonShape> shapes;  ///< per polygon
  radiosity::Box3 bounds;            ///< of what polygons use, m; empty without polygons
  double size = 0;                   ///< diagonal of the bounds, m
  double thickness = 0;  ///< how far off a plane, or off each other, points may be that were meant
                         ///< to lie in it, or on each other, m; see radiosity::plane_thickness

  [[nodiscard]] std::int32_t surface(radiosity::Index polygon) const {
    return scene.polygon_surface[polygon];
  }
  [[nodiscard]] bool is_two_sided(radiosity::Index polygon) const {
    return scene.surfaces[surface(polygon)].two_sided;
  }
  [[nodiscard]] bool is_usable(radiosity::Index polygon) const {
    return shapes[polygon].kind != PolygonKind::zero_area &&
           shapes[polygon].kind != PolygonKind::self_crossing;
  }
  /// True if the polygon's material emits light.
  [[nodiscard]] bool emits(radiosity::Index polygon) const;
  /// Corner positions, m.
  [[nodiscard]] std::vector<radiosity::Vec3> points(radiosity::Index polygon) const;
  /// Mean of the corners, m.
  [[nodiscard]] radiosity::Vec3 center(radiosity::Index polygon) const;
  /// Unit normal; only of usable polygons.
  [[nodiscard]] radiosity::Vec3 normal(radiosity::Index polygon) const {
    return shapes[polygon].vector_area.normalized();
  }
  /// Half-edge direction of a corner: true if it runs from ends[0] to ends[1] of its edge.
  [[nodiscard]] bool is_forward(std::int64_t corner) const {
    return polygons.corners[corner] == edges.ends[edges.edge_of_corner[corner]][0];
  }
};

/// Prepares a scene; never throws for bad geometry.
ExaminedScene examine(const radiosity::Scene& scene);

}  // namespace meshing
