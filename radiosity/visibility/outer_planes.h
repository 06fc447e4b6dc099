#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// The patches that block something, one of each pair of twins: those in a plane that has the whole
/// scene on one side (a wall of a convex room) don't.
/// `thickness` is how far off a plane points may be and still count as on it, m.
std::vector<std::int32_t> find_blocking_patches(const PatchMesh& mesh, double thickness);

}  // namespace radiosity
