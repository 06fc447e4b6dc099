#pragma once

#include <optional>
#include <span>
#include <string>

#include "radiosity/base/geometry.h"

namespace io {

/// How far the coordinates of a file may be off what was meant, in the file's unit.
struct Rounding {
  double precision = 0;  ///< what to reckon with: at most 1e-5 of the diagonal of the points' box
  double of_digits = 0;  ///< what the digits say, which is more where a large offset uses them up
};

/// How coordinates were rounded, as far as their digits tell: half a unit in the last place that
/// they share, or of single precision; 0 if nothing says that they were. Judged are the distinct
/// magnitudes among up to 20,000 coordinates, each by the fewest decimal digits that bring it back:
///  - single precision, if 95 % of those with eight digits and more are nearest to a `float`;
///  - D digits, 5 <= D <= 12, if at least 6 of them have D digits, and at least a third as many as
///    have more (the largest such D).
/// So few digits are taken for what was meant, and so are those of double precision.
Rounding found_rounding(std::span<const radiosity::Vec3> points);

/// The same for points that are known to be stored in single precision: 0 if all of them have so
/// few digits that they are exact. `quantised` is what they are off for being stored as integers.
Rounding single_rounding(std::span<const radiosity::Vec3> points, double quantised = 0);

/// What to tell the user if the digits say ten times more than what is reckoned with.
std::optional<std::string> rounding_warning(const Rounding& rounding);

}  // namespace io
