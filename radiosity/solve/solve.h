#pragma once

#include <Eigen/Core>

#include "radiosity/operator/transport.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// Solves B = M_e + ρ F B for every column at once. `exitance` is n x k; `reflectance` n x b, where
/// b divides k: column c uses reflectance column c % b, so several right-hand sides (all bands of
/// one, then of the next) share a solve. The bound is ‖ΔB‖ <= ρ_max^½ ‖ρ^-½ r‖ / (1 - q) with a
/// proved bound q < 1 on the spectral radius of ρ F, usually ρ_max or less; where white patches (ρ
/// = 1) prevent a proof, the iteration ends at the residual that is asked for and `converged` is
/// false. From darkness, patches that no light can reach stay exactly 0; another start may leave
/// its rounding errors there, and its light in closed white rooms that are not lit, for which no
/// bound is proved. Throws SolveError if the sizes do not fit, a value is not finite, negative (but
/// for the start and, if there may be, sinks) or a reflectance above 1, or if no solution exists (ρ
/// = 1 on all patches of a closed room that is lit); Interrupted.
Solution solve(const Transport& transport, const Eigen::MatrixXd& exitance,
               const Eigen::MatrixXd& reflectance, const SolveOptions& options = {});

}  // namespace radiosity
