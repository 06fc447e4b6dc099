#pragma once

#include <memory>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Computes the exchange areas of all pairs of patches, and keeps all; those of a part of a
/// symmetric whole with all images of the other patch, so that a flat patch may see itself. Same
/// input, same bits, at any number of threads. Throws SolveError if the operator does not fit into
/// memory, with the figure and a way out, before it starts; Interrupted if asked to stop.
std::unique_ptr<Transport> make_dense_transport(const PatchMesh& mesh, const Visibility& visibility,
                                                const TransportOptions& options = {});

}  // namespace radiosity
