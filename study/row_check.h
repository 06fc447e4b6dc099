#pragma once

#include <Eigen/Core>
#include <functional>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace study {

/// Throws SolveError if a row of form factors adds up to more than 1 by more than its errors and
/// the tolerance (at least 1 %) explain: then more light would arrive than was sent. The message
/// names the worst patch, and polygons that overlap in one plane if there are any, since fronts
/// that lie in the same place both receive the light, or that the patch is hardly larger than the
/// coordinates' digits. `row_error` gives the standard errors of a row; it is asked for once, and
/// only if something is wrong.
void refuse_excess(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                   const radiosity::AssemblyReport& report, double tolerance,
                   const std::function<Eigen::VectorXd(radiosity::Index)>& row_error);

}  // namespace study
