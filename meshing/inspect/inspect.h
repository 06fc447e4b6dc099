#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshing/inspect/finding.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// Counts, measures and problems of a scene.
struct Inspection {
  radiosity::Index n_vertices = 0;
  radiosity::Index n_polygons = 0;
  radiosity::Index n_triangles = 0;
  radiosity::Index n_quads = 0;
  radiosity::Index n_other = 0;
  double area = 0;                     ///< m²
  std::vector<double> surface_area;    ///< per surface, m²
  std::vector<long> surface_polygons;  ///< per surface
  radiosity::Box3 bounds;              ///< m
  /// Every edge is shared by two polygons (position-wise). Whether light escapes is another
  /// question: radiosity::is_enclosed().
  bool closed = false;
  long n_boundary_edges = 0;
  std::vector<Finding> findings;  ///< serious ones first
};

/// Examines a scene; never throws for bad geometry, that is what it reports.
Inspection inspect(const radiosity::Scene& scene);

/// Messages of the serious findings, to warn of before long work. None for scenes of more than
/// 200,000 polygons, where looking for them costs more than it tells.
std::vector<std::string> serious_findings(const radiosity::Scene& scene);

/// What there is to say of the first two polygons that overlap in one plane, facing the same way:
/// both receive the light there, which is not defined. Absent if there are none.
std::optional<std::string> overlap_finding(const radiosity::Scene& scene);

}  // namespace meshing
