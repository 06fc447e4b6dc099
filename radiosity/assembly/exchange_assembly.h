#pragma once

#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/cluster_tree.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Patches of a strip, at most.
inline constexpr Index kTileSize = 64;

/// The order of the tree, of its first part, and its largest clusters of at most kTileSize patches
/// as strips.
TileLayout tile_layout(const ClusterTree& tree);

/// Computes the entries of every tile that `sink` has not: facing test and clipping, shaft culling
/// with candidate occluders inherited down the cluster tree, the exact kernel for pairs proved
/// visible, sampled visibility for the rest. Of a part of a symmetric whole, its rows are made with
/// each entry the sum over all images of its column: G_ij = Σ_g G_i,g(j). As with an image g its
/// inverse is there, Σ_g G_i,g(j) = Σ_g G_j,g(i), and one of them is made for both. `coverage` is
/// the whole's.
void assemble_tiles(const WholeMesh& whole, const Visibility& visibility,
                    const TransportOptions& options, const Coverage& coverage, TileSink& sink);

}  // namespace radiosity
