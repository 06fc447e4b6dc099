#pragma once

#include <Eigen/Core>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/neighbor_groups.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// One standard error of each patch's radiosity, W/m², n x k, that comes from light which varies
/// within patches. Where B_j(y) differs from its mean, patch i receives wrongly the covariance of
/// B_j(y) with the factor F_i(y) that belongs to the point y of patch j. Both are guessed from the
/// form factors at hand. Over patch j the exchange with patch k, at the distance d_jk of centroids,
/// varies by v_jk = min(2, √A_j / d_jk) of itself: wholly where k is closer than j is large. As
/// what one patch gets more the others get less, F_jk varies by F_jk c_jk, c_jk = v_jk - Σ_m F_jm
/// v_jm, so that light stuck in a narrow gap is missed everywhere else. Of j's own light it makes
///     D_j² = ρ_j² Σ_k (F_jk v_jk (B_k - H_j))²,
/// and s_i² = ρ_i² Σ_j (F_ij c_ji D_j)² is received wrongly; a patch that is half covered by
/// another in contact with it comes out right. Reflections of that are added by a few solutions in
/// which `groups` of neighbours share a random sign. Costs all rows of F twice and those solutions;
/// of an operator with sums over pairs some of these, with the means of distant clusters.
/// Deterministic.
Eigen::MatrixXd uneven_light_error(const PatchMesh& mesh, const Transport& transport,
                                   const Solution& solution, const NeighborGroups& groups,
                                   const Progress& progress = {});

}  // namespace radiosity
