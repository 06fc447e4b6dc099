#pragma once

#include <Eigen/Core>
#include <vector>

#include "apps/validation/plot/surface_map.h"
#include "apps/validation/reference/cornell_reference.h"

namespace apps::validation {

/// The surfaces of the box, each as seen from its front, coloured by the relative difference of the
/// radiosity `computed` (per polygon, n x 3, W/m²), bands added up, from the reference. Polygons in
/// `left_out` and the light have no colour.
SurfaceMap difference_map(const std::vector<ReferencePolygon>& reference,
                          const Eigen::MatrixXd& computed,
                          const std::vector<std::size_t>& left_out);

}  // namespace apps::validation
