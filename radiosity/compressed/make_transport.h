#pragma once

#include <cstddef>
#include <memory>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/geometry.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// How an operator in memory is kept.
enum class TransportKind {
  automatic,  ///< dense up to kMostDense patches, or where much is asked, if that fits into memory;
              ///< else compressed
  dense,      ///< all form factors (make_dense_transport)
  compressed  ///< far and near blocks (make_compressed_transport)
};

/// Up to so many patches an operator is dense if nobody says otherwise: all its form factors are
/// there, each with an error of its own, for some 240 MB. Beyond, what compressed ones save grows
/// with each patch (docs/DESIGN.md has figures).
inline constexpr Index kMostDense = 10'000;

/// Below this tolerance it is dense however many patches there are: the verified error of
/// compressed ones may not come down to it.
inline constexpr double kLeastCompressed = 5e-3;

/// What an operator is wanted for.
struct TransportChoice {
  TransportKind kind = TransportKind::automatic;
  bool by_rows = false;  ///< for a method that goes by rows, over and over: dense
  int n_ranks = 1;       ///< processes that keep a dense one together, if there is memory on each
};

/// What the choice comes to for so many patches and a tolerance of the form factors, dense or
/// compressed, with `memory` bytes allowed (0 = what the machine has).
TransportKind chosen_kind(const TransportChoice& choice, Index n_patches, double tolerance,
                          std::size_t memory = 0);

/// Throws SolveError, with the predicted figures and the way out, if an operator of that choice
/// does not fit into `memory` bytes (0 = what the machine has), and if it is to be compressed for a
/// method that goes by rows. `n_polygons` is the number of polygons of the scene, below which no
/// choice of patches can go; 0 if it is not known.
void check_choice(const TransportChoice& choice, Index n_patches, Index n_polygons,
                  double tolerance, std::size_t memory = 0);

/// Makes the operator of all exchange areas, dense or compressed: AssemblyReport::compression tells
/// which. That of a part of a symmetric whole (PatchMesh::images) is dense. A compressed one is
/// verified for `light`, too, and does not use TransportOptions::known. Same input, same bits, at
/// any number of threads. Throws SolveError as check_choice does, before it starts; Interrupted if
/// asked to stop.
std::unique_ptr<Transport> make_transport(const PatchMesh& mesh, const Visibility& visibility,
                                          const TransportOptions& options = {},
                                          const TransportChoice& choice = {},
                                          const ExpectedLight& light = {});

}  // namespace radiosity
