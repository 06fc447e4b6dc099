#pragma once

#include "meshing/patches/edge_division.h"
#include "meshing/patches/patch_count.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// Builds the patches of a division: quads become grids, triangles with equally divided edges
/// similar triangles, other polygons are filled with triangles that fit the division of their
/// edges. Tells `progress` how far it is: patches that are made, those that are filled
/// in twice. Throws MeshError for polygons
/// that cross themselves, and Interrupted.
radiosity::PatchMesh build_patches(const radiosity::Scene& scene, const Topology& topology,
                                   const EdgeDivision& division,
                                   const radiosity::Progress& progress);

}  // namespace meshing
