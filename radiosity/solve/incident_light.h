#pragma once

#include <Eigen/Core>

#include "radiosity/solve/solution.h"

namespace radiosity {

/// The solution for light from without. With direct irradiance E (of the sun) patches reflect ρ E
/// at once, so that B = (M_e + ρ E) + ρ F B: `solution` is that of the sources M_e + ρ E
/// (initial_radiosity). Told apart again: M_e is emitted, H = F B + E arrives, and of the power
/// ΣAE that is incident the patches absorb ΣA(1 - ρ)E before any reflection. `exitance` is n x k,
/// `incident` n x b with b bands, of which k is a multiple; nothing changes if it is empty. `area`
/// has n values, m².
Solution with_incident(Solution solution, const Eigen::MatrixXd& exitance,
                       const Eigen::MatrixXd& incident, const Eigen::VectorXd& area);

}  // namespace radiosity
