#pragma once

#include <Eigen/Core>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/solve/irradiance_system.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// Bound on ‖ΔB‖/‖B‖ (energy norm, largest over the columns) that the standard errors of the form
/// factors cause, with δ = Transport::error() >= ‖ΔF̂‖₂: the true B solves the equation with
/// F̂ + ΔF̂, so B_true - B = (I - ρ F_true)^-1 ρ ΔF B and
///     ‖ΔB‖/‖B‖ <= ρ_max δ min(1 / (1 - ρ_max), 1 / (1 - q - ρ_max δ)),
/// the first because true row sums are at most 1. Infinite if neither denominator is positive.
double transport_error_bound(const IrradianceSystem& system);

/// One standard error of each radiosity, W/m², n x k, to first order from independent errors of the
/// exchange areas, which make H = F B uncertain by σ(H) (Transport::apply_error):
///  - local, ρ_i σ(H_i);
///  - shared by the patches through reflection: its mean in closed form with all correlations, the
///    rest as the mean square over a few solutions for ρ σ(H) with random signs;
///  - what the iteration left undone, ρ |F B - H| / (1 - q).
/// Against many perturbed operators it is right within 15 % (median over the patches).
/// Deterministic. Takes some tens of products, unless the form factors are exact. Reports "errors".
Eigen::MatrixXd radiosity_error(const IrradianceSystem& system, const Iterate& iterate,
                                const Progress& progress);

/// What sources of radiosity, which may be negative, cause by reflection among the patches of
/// `solution`: (I - ρ F)^-1 of them less themselves, W/m², n x c, to 1 %. Their number c is that of
/// the solution's columns or a multiple of it.
Eigen::MatrixXd reflected_light(const Transport& transport, const Solution& solution,
                                Eigen::MatrixXd sources, const Progress& progress = {});

}  // namespace radiosity
