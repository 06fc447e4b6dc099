#pragma once

#include <Eigen/Core>
#include <vector>

namespace radiosity {

/// Wavelengths that the table of the standard observer covers, nm. What lies outside is not seen.
inline constexpr double kShortestVisible = 360;
inline constexpr double kLongestVisible = 830;

/// The colour matching functions x̄, ȳ, z̄ of the CIE 1931 standard colorimetric observer (2°) at a
/// wavelength in nm, linear between the values of the table at every 5 nm; 0 outside 360..830 nm.
/// ȳ is the spectral luminous efficiency V(λ) of photopic vision. (CIE 015:2018)
Eigen::Vector3d color_matching(double wavelength);

/// Weights (nm) by which samples at these wavelengths (nm, increasing) add up to their integral
/// over wavelength, trapezoidal rule: half the distance between the neighbours on either side. A
/// single wavelength spans nothing: its weight is 0.
Eigen::VectorXd integration_weights(const std::vector<double>& wavelengths);

/// Weights of a spectrum sampled at these wavelengths (nm, increasing) in its tristimulus values:
/// (X, Y, Z) = spectrum * weights with X = ∫ S(λ) x̄(λ) dλ by the trapezoidal rule, so Y of a
/// spectrum in W/(m² nm) times 683 lm/W is in lm/m². n x 3, nm.
Eigen::MatrixX3d tristimulus_weights(const std::vector<double>& wavelengths);

/// The matrix to linear sRGB from X, Y, Z: rgb = M xyz. Y = 1 with the chromaticity of D65 gives
/// (1, 1, 1); there is no adaptation to another white. (IEC 61966-2-1:1999)
Eigen::Matrix3d xyz_to_srgb();

/// Luminance of linear sRGB (Rec. 709) relative to that of white: its Y.
inline const Eigen::Vector3d kSrgbLuminance(0.2126, 0.7152, 0.0722);

}  // namespace radiosity
