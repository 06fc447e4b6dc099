#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// A partition of the patches into groups, each small in extent and nearly flat.
struct NeighborGroups {
  std::vector<std::int32_t> group_of;  ///< per patch: its group
  Index n_groups = 0;
};

/// Groups of patches that are neighbours: those of one `PatchMesh::family`; of those without, about
/// four of one surface that face alike (2 x 2 in a grid). Deterministic.
NeighborGroups make_neighbor_groups(const PatchMesh& mesh);

/// The same one level coarser: groups of about four of `finer`, of one surface.
NeighborGroups make_coarser_groups(const PatchMesh& mesh, const NeighborGroups& finer);

}  // namespace radiosity
