#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/neighbor_groups.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// What it would cost to know less about the radiosity: the error that merging a group of patches
/// into one would cause, as the square of its share in the relative error of the whole.
struct RefinementIndicator {
  NeighborGroups groups;
  Eigen::VectorXd squared_error;  ///< per group
};

/// For each group J of neighbours, with relative weights w_i and in a mean over the bands,
///     Σ_i A_i w_i² (ρ_i Σ_{j in J} F_ij (B_j - B̄_J))² / Σ A: what the others receive wrongly, and
///     Σ_{i in J} A_i w_i² (B_i - B'_i)² / Σ A, weighted by 1/100: how far the picture, which shows
/// values interpolated between corners, B', is off, so that shadow edges count. Weights make errors
/// relative to the reflected light of a patch, or to a twentieth of the mean where it is darker.
/// Costs all rows of F, or of an operator without quick ones its sums over pairs, which leave out
/// corrections and, of light that varies within a group, what blocks do not resolve.
RefinementIndicator refinement_indicator(const PatchMesh& mesh, const Transport& transport,
                                         const Solution& solution, const Progress& progress = {});

/// The patches, `most` at most, of the fewest groups that hold `share` of the sum of squared
/// errors, worst first. Increasing.
std::vector<Index> patches_to_refine(const RefinementIndicator& indicator, double share,
                                     Index most);

}  // namespace radiosity
