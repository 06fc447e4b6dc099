#pragma once

#include "radiosity/assembly/transport_options.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Completes the report of an operator without multipliers by its row sums and, if it says that the
/// scene is closed, makes these 1 by changes of d_ab² (μ_i + μ_j) to the densities, which keep
/// symmetry. Rows further off than their errors and the tolerance explain are left alone.
void close_blocks(CompressedTransport& transport, const PatchMesh& mesh,
                  const Visibility& visibility, const TransportOptions& options);

}  // namespace radiosity
