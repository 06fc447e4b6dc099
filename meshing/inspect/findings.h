#pragma once

#include <vector>

#include "meshing/inspect/examined_scene.h"
#include "meshing/inspect/finding.h"

namespace meshing {

/// The examinations, each in its own source file.
std::vector<Finding> find_bad_polygons(const ExaminedScene& examined);
std::vector<Finding> find_duplicates(const ExaminedScene& examined);
std::vector<Finding> find_coplanar_overlaps(const ExaminedScene& examined);
std::vector<Finding> find_non_manifold_edges(const ExaminedScene& examined);
std::vector<Finding> find_flipped_orientation(const ExaminedScene& examined);
std::vector<Finding> find_gaps(const ExaminedScene& examined);

/// How edges of one-sided polygons are shared; two-sided polygons neither open nor close a scene.
struct Closure {
  bool closed = false;
  long n_boundary_edges = 0;  ///< edges of one polygon only
};
Closure examine_closure(const ExaminedScene& examined);

}  // namespace meshing
