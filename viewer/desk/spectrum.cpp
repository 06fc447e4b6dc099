#include "viewer/desk/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "radiosity/solve/quantity.h"

namespace viewer {

using radiosity::Index;

SpectrumAxes spectrum_axes(const radiosity::Bands& bands, const Eigen::VectorXd& radiosity,
                           const Eigen::VectorXd& irradiance) {
  Eigen::VectorXd all(radiosity.size() + irradiance.size() + 1);
  all << radiosity, irradiance, 0;
  return {.wavelengths = {.low = bands.wavelengths.front(), .high = bands.wavelengths.back()},
          .values = io::fitting_scale(all, false, {.low_percent = 0, .high_percent = 100})};
}

Index nearest_band(const radiosity::Bands& bands, double wavelength) {
  const auto nearest = std::min_element(
      bands.wavelengths.begin(), bands.wavelengths.end(),
      [&](double a, double b) { return std::abs(a - wavelength) < std::abs(b - wavelength); });
  return nearest - bands.wavelengths.begin();
}

std::string band_text(const PatchFacts& facts, const radiosity::Bands& bands, Index band) {
  return fmt::format("{}: B {}, H {} {}, ρ {}",
                     radiosity::band_names(bands)[static_cast<std::size_t>(band)],
                     number_text(facts.radiosity[band], 3), number_text(facts.irradiance[band], 3),
                     radiosity::band_unit("W/m²", bands), number_text(facts.reflectance[band], 3));
}

}  // namespace viewer
