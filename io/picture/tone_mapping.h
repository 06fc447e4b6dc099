#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "io/picture/rgb_picture.h"

namespace io {

/// Linear sRGB to show, n x 3, of n colours in any number of bands (n x n_bands). With
/// `wavelengths` (nm, increasing, one per band) the spectra are seen by the CIE 1931 observer, as
/// `radiosity::tristimulus_weights` and `xyz_to_srgb` say: Y is ∫ S ȳ dλ, and what no screen can
/// show has a negative component. Without, three bands are R, G, B. Else, and if nothing of the
/// wavelengths' integral is visible (infrared, a single wavelength), they show as grey, their mean.
Eigen::MatrixX3f display_colors(const Eigen::MatrixXf& values,
                                const std::vector<double>& wavelengths = {});

/// Factor from linear RGB to display value that exposes the colours well: the luminance that 98 %
/// of the lit ones stay below becomes a light grey. Lights seen directly are left out as long as
/// they are at most a tenth of what is lit and stand out from the rest. 1 if all is black.
double automatic_exposure(const Eigen::MatrixX3f& colors);

/// 8-bit sRGB (IEC 61966-2-1) of a linear colour times `exposure`; what is brighter than white
/// becomes white, and a negative component 0.
Rgb srgb_bytes(const Eigen::RowVector3f& color, double exposure);

}  // namespace io
