#pragma once

#include "radiosity/coverage.h"
#include "radiosity/exchange_tiles.h"
#include "radiosity/patch_mesh.h"
#include "radiosity/transport.h"
#include "radiosity/visibility.h"

namespace radiosity {

/// Exchange areas of all pairs, in the order of a cluster tree.
struct Assembly {
  std::vector<std::int32_t> order;  ///< patch of each row
  ExchangeTiles tiles;
  Eigen::VectorXd row_sums;  ///< Σ_j G_ij before rounding and correction, m², tree order
  AssemblyReport report;     ///< before correction
};

/// Computes the entries of every tile that `sink` has not: facing test and clipping, shaft culling
/// with candidate occluders inherited down the cluster tree, the exact kernel for pairs proved
/// visible, sampled visibility for the rest. `coverage` is the mesh's.
void assemble_tiles(const PatchMesh& mesh, const Visibility& visibility,
                    const TransportOptions& options, const Coverage& coverage, TileSink& sink);

/// The same for tiles in memory.
Assembly assemble_exchange_areas(const PatchMesh& mesh, const Visibility& visibility,
                                 const TransportOptions& options, const Coverage& coverage);

}  // namespace radiosity
