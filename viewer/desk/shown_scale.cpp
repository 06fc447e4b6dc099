#include "viewer/desk/shown_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/picture/color_bar.h"
#include "io/picture/round_numbers.h"

namespace viewer {
namespace {

constexpr double kLeastRatio = 1e-6;  // of the ends of a logarithmic scale
constexpr double kMostRatio = 0.1;
constexpr double kLeastSpan = 0.05;  // of a dragged scale, relative to what it was
constexpr double kMostSpan = 3;
constexpr double kFineness = 0.01;

/// Infinite if no value is above 0.
double least_above_zero(const Eigen::VectorXd& values) {
  double least = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (value > 0) least = std::min(least, value);
  }
  return least;
}

}  // namespace

io::ColorScale shown_scale(const Look& look, const Eigen::VectorXd& values) {
  const double least = look.logarithmic ? least_above_zero(values) : 0;
  const bool is_logarithmic =
      look.logarithmic && std::isfinite(least) && (!look.range || look.range->high > 0);
  if (!look.range) {
    io::ScaleChoice choice = look.fit;
    choice.is_symmetric = look.map == io::ColorMap::diverging;
    return io::fitting_scale(values, is_logarithmic, choice);
  }
  io::ColorScale scale = *look.range;
  scale.logarithmic = is_logarithmic;
  if (is_logarithmic && !(scale.low > 0)) {
    scale.low = std::clamp(least, kLeastRatio * scale.high, kMostRatio * scale.high);
  }
  return scale;
}

std::vector<double> legend_ticks(const Look& look, const io::ColorScale& scale, int most) {
  constexpr double kMostTicks = 200;
  const double step = look.tick_spacing.value_or(0);
  const bool is_usable =
      step > 0 && !scale.logarithmic && (scale.high - scale.low) / step <= kMostTicks;
  if (!is_usable) return io::tick_values(scale, most);
  std::vector<double> ticks;
  constexpr double kOnTick = 1e-9;  // of a step: what is as near to an end is on it
  const double first = std::ceil(scale.low / step - kOnTick);
  const double last = std::floor(scale.high / step + kOnTick);
  for (double k = first; k <= last; ++k) ticks.push_back(k * step + 0.0);
  return ticks;
}

std::string scale_note(const Look& look, const io::ColorScale& scale) {
  if (scale.logarithmic) {
    const bool is_raised = look.range && !(look.range->low > 0);
    return is_raised ? "logarithmic, from the least above 0" : "logarithmic";
  }
  return look.logarithmic ? "linear: none is above 0" : "";
}

std::string fit_text(const Look& look) {
  if (look.range) return "as given";
  const char* of = is_plane(look.show) ? "points" : "patches";
  return fmt::format("{:g} to {:g} % of {}", look.fit.low_percent, look.fit.high_percent, of);
}

io::ColorScale dragged_scale(const io::ColorScale& scale, BarEnd end, double position) {
  const double wanted = end == BarEnd::high ? std::clamp(position, kLeastSpan, kMostSpan)
                                            : std::clamp(position, 1 - kMostSpan, 1 - kLeastSpan);
  // As fine as a hand is.
  const double step = scale.logarithmic ? io::round_down(io::value_at(scale, wanted) * kFineness)
                                        : io::round_down((scale.high - scale.low) * kFineness);
  const double value = step * std::round(io::value_at(scale, wanted) / step);
  io::ColorScale dragged = scale;
  (end == BarEnd::high ? dragged.high : dragged.low) = value;
  return dragged;
}

}  // namespace viewer
