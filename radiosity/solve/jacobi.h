#pragma once

#include "radiosity/solve/irradiance_system.h"

namespace radiosity {

/// Jacobi's iteration (Neumann series, gathering): H ← F (M_e + ρ H), one bounce of light per
/// product. The error shrinks by q per step.
Iterate jacobi(const IrradianceSystem& system, SolveMonitor& monitor);

/// Chebyshev semi-iteration (Golub & Varga 1961): Jacobi's steps combined with the polynomials that
/// are smallest on [-q, q], which holds the eigenvalues of F ρ. The error shrinks by about
/// q / (1 + sqrt(1 - q²)) per step. No inner products needed.
Iterate chebyshev(const IrradianceSystem& system, SolveMonitor& monitor);

}  // namespace radiosity
