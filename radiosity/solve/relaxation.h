#pragma once

#include "radiosity/solve/irradiance_system.h"

namespace radiosity {

/// Gauss-Seidel iteration, patches in index order: each uses the newest radiosity of all others.
/// n rows of F make one sweep, the work of one product.
Iterate gauss_seidel(const IrradianceSystem& system, SolveMonitor& monitor);

/// Southwell relaxation, "progressive refinement" (Cohen, Chen, Wallace & Greenberg 1988): the
/// patch with the most unshot power, summed over the columns, sends it to all others. n shots are
/// the work of one product; a shot counts as one iteration.
Iterate southwell(const IrradianceSystem& system, SolveMonitor& monitor);

}  // namespace radiosity
