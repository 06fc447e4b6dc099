#pragma once

#include <vector>

#include "meshing/base/edge_table.h"
#include "meshing/base/polygon_shape.h"
#include "meshing/base/weld.h"
#include "meshing/patches/edge_division.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// A scene prepared for subdivision.
struct Topology {
  WeldedPolygons polygons;
  EdgeTable edges;
  std::vector<PolygonKind> kinds;  ///< per polygon; neither zero_area nor self_crossing
  std::vector<double> areas;       ///< per polygon, m²
};

/// How many patches a division gives.
struct PatchCount {
  double certain = 0;    ///< patches of polygons that are divided regularly
  double estimated = 0;  ///< of polygons that are filled with triangles, within some 20 %
};

/// Counts without building. Two-sided polygons count twice.
PatchCount count_patches(const radiosity::Scene& scene, const Topology& topology,
                         const EdgeDivision& division);

}  // namespace meshing
