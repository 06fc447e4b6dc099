#pragma once

#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/cluster_tree.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Patches of a strip, at most.
inline constexpr Index kTileSize = 64;

/// The tree's order, and its largest clusters of at most kTileSize patches as strips.
TileLayout tile_layout(const ClusterTree& tree);

/// Computes the entries of every tile that `sink` has not: facing test and clipping, shaft culling
/// with candidate occluders inherited down the cluster tree, the exact kernel for pairs proved
/// visible, sampled visibility for the rest. `coverage` is the mesh's.
void assemble_tiles(const PatchMesh& mesh, const Visibility& visibility,
                    const TransportOptions& options, const Coverage& coverage, TileSink& sink);

}  // namespace radiosity
