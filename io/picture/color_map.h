#pragma once

#include <Eigen/Core>
#include <vector>

#include "io/picture/rgb_picture.h"

namespace io {

/// The range of values that a colour bar spans.
struct ColorScale {
  double low = 0;
  double high = 1;           ///< above low
  bool logarithmic = false;  ///< then low > 0
};

/// A scale for the values: from their minimum to what 98 % of them stay below, widened to round
/// numbers (multiples of the ticks' step; of 1, 2, 5 times a power of ten if logarithmic, where
/// only values above 0 count and at most six decades are shown). Values that are not finite are
/// left out. Something to look at even if there are none or all are equal.
ColorScale fitting_scale(const Eigen::VectorXd& values, bool logarithmic);

/// Where a value lies on the scale, from 0 (low or below) to 1 (high or above).
double position_on(const ColorScale& scale, double value);

/// Values for labels: round numbers (1, 2 or 5 times a power of ten apart; of each decade 1, or 1,
/// 2, 5 if logarithmic), at most `most` of them (>= 2), at least the two ends.
std::vector<double> tick_values(const ColorScale& scale, int most);

enum class ColorMap {
  /// Dark blue, green, yellow, lightness rising evenly. (Smith & van der Walt 2015, matplotlib;
  /// public domain, CC0)
  viridis,
  /// For differences: blue, light grey in the middle, red. (Moreland 2009)
  cool_warm
};

/// 8-bit sRGB of a position in [0, 1].
Rgb map_color(double position, ColorMap map = ColorMap::viridis);

}  // namespace io
