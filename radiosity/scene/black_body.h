#pragma once

#include <Eigen/Core>

#include "radiosity/scene/scene.h"

namespace radiosity {

/// Second radiation constant c₂ = h c / k, µm K (CODATA 2018).
inline constexpr double kSecondRadiationConstant = 14387.768775039337;

/// Nominal effective temperature of the sun, K (IAU 2015 resolution B3).
inline constexpr double kSunTemperature = 5772;

/// Share of a black body's emission at wavelengths below λ, given λT in µm K, >= 0:
///     F_{0-λT} = 15/π⁴ ∫_x^∞ t³/(e^t - 1) dt,   x = c₂ / λT,
/// to 1e-15: for x >= 1 by Σ_n e^{-nx} (x³/n + 3x²/n² + 6x/n³ + 6/n⁴) (Chang & Rhee 1984), below by
/// the power series of the integral up to x (Bernoulli numbers).
double black_body_fraction(double wavelength_temperature);

/// Share of what a black body at `temperature` (K, >= 0) emits in each band; they sum to 1.
/// Grey: 1. Thermal bands: between their edges. Solar and infrared: all is infrared, or with a
/// split wavelength what is beyond that. At 0 K all is in the last band.
Eigen::VectorXd thermal_fractions(const Bands& bands, double temperature);

}  // namespace radiosity
