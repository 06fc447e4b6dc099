#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// Where the light of a patch comes from: Y, n x b, such that B_pc = Σ_j Y_jc M_jc for any exitance
/// M, of which Y_jc M_jc is what was emitted by patch j; the row of (I - ρ F)^-1 at `patch`.
/// Dimensionless, not negative. One solve finds it, since by reciprocity Fᵀ = A F A^-1:
///
///     Y_j = δ_jp + A_j H_j,  H = F X the irradiance of (I - ρ F) X = e_p ρ_p / A_p
///
/// (importance: Smits, Arvo & Salesin 1992). `reflectance` is n x b. `options` are those of that
/// solve; its errors are not estimated. Throws as `solve` does, and SolveError if there is no such
/// patch.
Eigen::MatrixXd importance(const Transport& transport, const Eigen::MatrixXd& reflectance,
                           Index patch, const SolveOptions& options = {});

}  // namespace radiosity
