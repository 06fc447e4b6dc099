#pragma once

#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// `solve` of the conditions, with options that hold the rest of them (with_conditions). Throws as
/// that does, but of heat a floating group, whose temperatures nothing fixes, is told by its
/// surfaces and what is given to it.
Solution solve(const PatchMesh& mesh, const Transport& transport, const Conditions& conditions,
               const SolveOptions& options);

}  // namespace radiosity
