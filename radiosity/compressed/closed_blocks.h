#pragma once

#include "radiosity/assembly/transport_options.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Reports the row sums of an operator without multipliers and, if its report says that the scene
/// is closed, makes these 1 by changes of d_ab² (μ_i + μ_j) to the densities, which keep symmetry.
/// Rows further off than their errors and `tolerance` explain are left alone.
void close_blocks(CompressedTransport& transport, double tolerance);

/// Closes an operator that close_blocks() closed once more, after other changes.
void close_again(CompressedTransport& transport, double tolerance);

/// Reports what of the light that reaches no front meets backs, and how many rows of a closed scene
/// lack more than that and errors of `options.tolerance` explain. Follows close_blocks().
void find_backs(CompressedTransport& transport, const PatchMesh& mesh, const Visibility& visibility,
                const TransportOptions& options);

}  // namespace radiosity
