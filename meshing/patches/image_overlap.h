#pragma once

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// Throws MeshError naming a polygon if a mirror plane goes through it, and two if one of the part
/// passes through an image of the other or covers some of it, both facing the same way. `mesh` has
/// the polygons of the scene as they are, and its images.
void refuse_overlapping_images(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh);

}  // namespace meshing
