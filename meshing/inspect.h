#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiosity/geometry.h"
#include "radiosity/scene.h"

namespace meshing {

/// Something about a scene that its author should know.
struct Finding {
  enum class Kind {
    degenerate_polygon,
    duplicate_polygon,
    coplanar_overlap,  ///< e.g. a light lying in the plane of a ceiling that has no hole for it
    non_planar_polygon,
    non_manifold_edge,
    flipped_orientation,  ///< normal seems to point the wrong way
    t_junction,
    gap,              ///< boundary edges that almost but not quite meet
    suspicious_unit,  ///< e.g. a room of 500 m: millimetres read as metres
  };
  enum class Severity { note, warning, serious };
  Kind kind;
  Severity severity;
  std::string surface;            ///< name of the surface concerned; empty if the whole scene
  radiosity::Index polygon = -1;  ///< input polygon concerned, file order, or -1
  long count = 1;                 ///< how many like this were found (only the first is described)
  std::string message;            ///< one line: what, where, and what to do about it
};

/// "coplanar-overlap" and so on, for machine-readable output.
std::string_view kind_name(Finding::Kind kind);

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
