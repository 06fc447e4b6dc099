#pragma once

#include <Eigen/Core>
#include <string>

#include "io/picture/color_map.h"
#include "radiosity/scene/scene.h"
#include "viewer/desk/patch_facts.h"

namespace viewer {

/// What the axes of a plot of spectra span.
struct SpectrumAxes {
  io::ColorScale wavelengths;  ///< nm
  io::ColorScale values;       ///< from 0, or from what is below it, to what holds all
};

/// Of bands with at least two wavelengths.
SpectrumAxes spectrum_axes(const radiosity::Bands& bands, const Eigen::VectorXd& radiosity,
                           const Eigen::VectorXd& irradiance);

/// The band whose wavelength is nearest; of bands with wavelengths.
radiosity::Index nearest_band(const radiosity::Bands& bands, double wavelength);

/// What a patch has in a band, for a person: "550 nm: B 0.12, H 0.34 W/(m² nm), ρ 0.7".
std::string band_text(const PatchFacts& facts, const radiosity::Bands& bands,
                      radiosity::Index band);

}  // namespace viewer
