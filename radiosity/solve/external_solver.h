#pragma once

#include "radiosity/solve/irradiance_system.h"
#include "radiosity/solve/linear_solver.h"

namespace radiosity {

/// One run of the solver for each column that is lit, from the monitor's start; what it has found
/// is gathered once by our own products, which are what residual and bound are taken from.
Iterate solve_externally(const IrradianceSystem& system, const LinearSolver& solver,
                         SolveMonitor& monitor);

}  // namespace radiosity
