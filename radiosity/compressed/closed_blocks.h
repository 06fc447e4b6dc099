#pragma once

#include <Eigen/Core>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// What the rows of a closed scene shall sum to, in the order of the patches, and 1, or 0 for rows
/// that are left as they are; both empty if the scene is not closed.
struct ClosedSums {
  Eigen::VectorXd wanted = {};
  Eigen::VectorXd mask = {};
};

/// Reports the row sums of an operator without multipliers, and finds what they shall be: 1 but for
/// what is covered. Rows may lack much more than their errors and `options.tolerance` explain,
/// since the errors of a row's blocks may go together: a patch that others of its cluster do not
/// resemble is off in all blocks alike. Rays tell whether these have openings. If they have, and
/// lack no more than that, or nobody knows, they are left alone.
ClosedSums find_closed_sums(CompressedTransport& transport, const PatchMesh& mesh,
                            const Visibility& visibility, const TransportOptions& options);

/// Makes rows sum to that, by changes of d_ab² (μ_i + μ_j) to the densities, which keep symmetry
/// and replace those made before.
void close_blocks(CompressedTransport& transport, const ClosedSums& sums);

/// Reports what of the light that reaches no front meets backs, and how many rows of a closed scene
/// lack more than that and errors of `options.tolerance` explain. Follows find_closed_sums().
void find_backs(CompressedTransport& transport, const PatchMesh& mesh, const Visibility& visibility,
                const TransportOptions& options);

}  // namespace radiosity
