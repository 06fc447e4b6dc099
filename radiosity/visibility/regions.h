#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// The region of free space that each patch looks into, n_patches: no straight line leads from a
/// patch to one of another region, since surfaces that hang together without a gap are between
/// them. What is closer than `thickness` (m) touches. All 0 if nothing is shut off. Patches
/// of different numbers are proved not to see each other; equal numbers prove nothing: where
/// patches pass through each other or lie on each other, the regions on all their sides count as
/// one.
///
/// About each edge the sides of the patches that meet there are joined to the next one around it,
/// which gives the connected parts of all regions' borders; a part that is not the outer border of
/// its region (by the sign of the volume within) is joined to what a ray meets that leaves it for
/// good, at its furthest corner in some direction.
std::vector<std::int32_t> find_regions(const PatchMesh& mesh, const Visibility& visibility,
                                       double thickness);

}  // namespace radiosity
