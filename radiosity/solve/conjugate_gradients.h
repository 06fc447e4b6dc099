#pragma once

#include "radiosity/solve/irradiance_system.h"

namespace radiosity {

/// Conjugate gradients (Hestenes & Stiefel 1952) on (I - F ρ) H = F M_e in the inner product
/// Σ A ρ u v, which is the same as on the symmetrised I - R F̂ R. One independent iteration per
/// column, one product per step for all columns that have not converged yet.
Iterate conjugate_gradients(const IrradianceSystem& system, SolveMonitor& monitor);

/// The irradiance alone, n x k, by one run whose bound holds but for rounding: without the product
/// with all columns that would prove it.
Eigen::MatrixXd unproved_irradiance(const IrradianceSystem& system, SolveMonitor& monitor);

}  // namespace radiosity
