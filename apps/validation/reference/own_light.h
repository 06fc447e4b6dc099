#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "study/study.h"

namespace apps::validation {

/// The scene's radiosity by its own materials.
radiosity::Solution solve_own_light(const study::Study& assembly,
                                    const radiosity::SolveOptions& options = {});

/// Patch areas, m².
Eigen::Map<const Eigen::VectorXd> areas(const radiosity::PatchMesh& mesh);

/// Area-weighted means over the scene's polygons of values per patch, n_polygons x n_columns.
Eigen::MatrixXd polygon_means(const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& values,
                              radiosity::Index n_polygons);

}  // namespace apps::validation
