#include "io/picture/tone_mapping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <vector>

#include "radiosity/scene/color_matching.h"

namespace io {
namespace {

using Eigen::Index;

std::uint8_t srgb_byte(double linear) {
  if (!(linear > 0)) return 0;
  const double value = std::min(linear, 1.0);
  const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

}  // namespace

Eigen::MatrixX3f display_colors(const Eigen::MatrixXf& values,
                                const std::vector<double>& wavelengths) {
  if (wavelengths.empty() && values.cols() == 3) return values;
  if (!wavelengths.empty()) {
    assert(static_cast<Index>(wavelengths.size()) == values.cols());
    const Eigen::MatrixX3d to_xyz = radiosity::tristimulus_weights(wavelengths);
    const Eigen::MatrixX3f to_srgb = (to_xyz * radiosity::xyz_to_srgb().transpose()).cast<float>();
    if (!to_xyz.isZero(0)) return values * to_srgb;
  }
  return values.rowwise().mean().replicate(1, 3);
}

double automatic_exposure(const Eigen::MatrixX3f& colors) {
  constexpr double kWhite = 0.85;  // linear display value of the bright end
  constexpr float kStandsOut = 4;  // brighter than the rest by this factor is a light

  const Eigen::VectorXf luminance = colors * radiosity::kSrgbLuminance.cast<float>();
  std::vector<float> lit;
  std::copy_if(luminance.begin(), luminance.end(), std::back_inserter(lit),
               [](float value) { return value > 0 && std::isfinite(value); });
  if (lit.empty()) return 1;
  std::sort(lit.begin(), lit.end());
  const auto quantile = [&](double fraction) {
    return lit[static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(lit.size() - 1)))];
  };

  // Antialiased rims of a light lie between it and the rest, so the jump is sought across 2 %.
  float white = quantile(0.98);
  for (int percent = 98; percent >= 92; --percent) {
    const float below = quantile(0.01 * percent - 0.02);
    if (quantile(0.01 * percent) > kStandsOut * below) white = below;
  }
  return kWhite / white;
}

Rgb srgb_bytes(const Eigen::RowVector3f& color, double exposure) {
  return {srgb_byte(exposure * color[0]), srgb_byte(exposure * color[1]),
          srgb_byte(exposure * color[2])};
}

}  // namespace io
