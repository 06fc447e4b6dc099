#pragma once

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// Index of the material of a patch: backs may have one of their own.
int material_of(const Scene& scene, const PatchMesh& mesh, Index patch);

}  // namespace radiosity
