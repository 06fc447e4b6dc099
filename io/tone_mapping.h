#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace io {

/// Linear RGB to show, n x 3, of n colours in any number of bands (n x n_bands). One or two bands
/// show as grey (their mean); three are R, G, B; more are taken as ordered by wavelength, and blue,
/// green and red are the means of their lowest, middle and highest third (a false colour).
Eigen::MatrixX3f display_colors(const Eigen::MatrixXf& values);

/// Factor from linear RGB to display value that exposes the colours well: the luminance that 98 %
/// of the lit ones stay below becomes a light grey. Lights seen directly are left out as long as
/// they are at most a tenth of what is lit and stand out from the rest. 1 if all is black.
double automatic_exposure(const Eigen::MatrixX3f& colors);

/// 8-bit sRGB (IEC 61966-2-1) of a linear colour times `exposure`; what is brighter than white
/// becomes white.
std::array<std::uint8_t, 3> srgb_bytes(const Eigen::RowVector3f& color, double exposure);

}  // namespace io
