#pragma once

#include <Eigen/Core>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// The values at a patch's corners (rows 4 i ..., as of `corner_values`) interpolated to a point on
/// it: bilinear in quads, barycentric in triangles. Of points beside it, that of a point on its
/// border.
Eigen::RowVectorXd interpolate(const PatchMesh& mesh, const Eigen::MatrixXd& corners, Index i,
                               const Vec3& point);

}  // namespace radiosity
