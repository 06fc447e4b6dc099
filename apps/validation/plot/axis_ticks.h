#pragma once

#include <string>
#include <vector>

#include "apps/validation/plot/plot.h"

namespace apps::validation {

/// The values that an axis spans and where it is marked.
struct AxisRange {
  Axis::Scale scale = Axis::Scale::linear;
  double low = 0;
  double high = 1;              ///< above low
  std::vector<double> ticks{};  ///< increasing, within [low, high]

  /// Where a value stands: 0 at `low`, 1 at `high`.
  [[nodiscard]] double position(double value) const;
  /// Whether the axis can show the value at all.
  [[nodiscard]] bool shows(double value) const;
};

/// A range that holds all values that the scale can show, with a little room at both ends, and
/// about five ticks: at 1, 2 or 5 times a power of ten, or on a logarithmic axis of two decades and
/// more at powers of ten. From 0 to 1 (1 to 10) if there is nothing to show.
AxisRange make_range(Axis::Scale scale, const std::vector<double>& values);

/// The text at a tick: "0.25", "2000", "10⁻³".
std::string tick_text(double value, Axis::Scale scale);

}  // namespace apps::validation
