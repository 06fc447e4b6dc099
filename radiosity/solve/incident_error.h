#pragma once

#include <Eigen/Core>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// The solution with what light from without may be off, W/m², n x k, added to its
/// `radiosity_error` in quadrature, as one standard error: ρ ΔH_0 of a patch and what reflection
/// makes of it if it is off everywhere to the same side, (I - ρ F)^-1 ρ ΔH_0, to 1 %. The same if
/// there is none, or no error was asked for.
Solution with_incident_error(Solution solution, const Transport& transport,
                             const Eigen::MatrixXd& error, const Progress& progress = {});

}  // namespace radiosity
