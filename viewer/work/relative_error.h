#pragma once

#include <optional>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace viewer {

/// Two standard errors of the radiosity, relative: 2 ‖σ‖/‖B‖ in the energy norm (Solution), the
/// largest over the bands. Empty if the errors are not known or nothing is lit.
std::optional<double> relative_error(const radiosity::PatchMesh& mesh,
                                     const radiosity::Solution& solution);

}  // namespace viewer
