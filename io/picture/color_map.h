#pragma once

#include <Eigen/Core>
#include <vector>

#include "io/picture/map_color.h"

namespace io {

/// The range of values that a colour bar spans.
struct ColorScale {
  double low = 0;
  double high = 1;           ///< above low
  bool logarithmic = false;  ///< then low > 0
};

/// Which values a scale spans that fits: those between these two ranks.
struct ScaleChoice {
  double low_percent = 0;     ///< so many percent of the values lie below the scale
  double high_percent = 98;   ///< and so many below its high end
  bool is_symmetric = false;  ///< with 0 in the middle, if any value is below 0; if linear
};

/// A scale for the values, as chosen, widened to round numbers (multiples of the ticks' step; of 1,
/// 2, 5 times a power of ten if logarithmic, where only values above 0 count and at most six
/// decades are shown). Values that are not finite are left out. Something to look at even if there
/// are none or all are equal.
ColorScale fitting_scale(const Eigen::VectorXd& values, bool logarithmic,
                         const ScaleChoice& choice = {});

/// Where a value lies on the scale, from 0 (low or below) to 1 (high or above).
double position_on(const ColorScale& scale, double value);

/// The value at a position, also beyond [0, 1].
double value_at(const ColorScale& scale, double position);

/// Values for labels: round numbers (1, 2 or 5 times a power of ten apart; of each decade 1, or 1,
/// 2, 5 if logarithmic), at most `most` of them (>= 2), at least the two ends.
std::vector<double> tick_values(const ColorScale& scale, int most);

}  // namespace io
