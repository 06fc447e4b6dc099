#include "io/picture/color_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "io/picture/round_numbers.h"

namespace io {
namespace {

constexpr double kMostDecades = 6;
// Rounding of a quotient that should be whole.
constexpr double kRounding = 1e-9;

/// The finite values, and of them only those above 0 if `logarithmic`, sorted.
std::vector<double> shown_values(const Eigen::VectorXd& values, bool logarithmic) {
  std::vector<double> shown;
  std::copy_if(values.begin(), values.end(), std::back_inserter(shown),
               [&](double value) { return std::isfinite(value) && (!logarithmic || value > 0); });
  std::sort(shown.begin(), shown.end());
  return shown;
}

/// What so many percent of the sorted values stay below.
double ranked(const std::vector<double>& sorted, double percent) {
  const double rank = percent * static_cast<double>(sorted.size() - 1) / 100;
  return sorted[static_cast<std::size_t>(rank)];
}

ColorScale logarithmic_scale(double low, double high) {
  high = round_up(high);
  low = round_down(std::max(low, high * std::pow(10, -kMostDecades)));
  if (!(low < high)) low = high / 10;
  return {low, high, true};
}

ColorScale linear_scale(double low, double high) {
  if (!(low < high)) {  // all alike: from 0 to them, or a unit around 0
    high = std::max(low, 0.0);
    low = std::min(low, 0.0);
    if (low == high) high = 1;
  }
  const double step = round_up((high - low) / 10);
  return {step * std::floor(low / step + kRounding), step * std::ceil(high / step - kRounding),
          false};
}

std::vector<double> logarithmic_ticks(const ColorScale& scale, int most, bool fine) {
  std::vector<double> ticks;
  const auto first = static_cast<int>(std::floor(std::log10(scale.low) + kRounding));
  const auto last = static_cast<int>(std::floor(std::log10(scale.high) + kRounding));
  for (int decade = first; decade <= last; ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = digit * std::pow(10, decade);
      const bool inside =
          tick >= scale.low * (1 - kRounding) && tick <= scale.high * (1 + kRounding);
      if (inside && (fine || digit == 1)) ticks.push_back(tick);
    }
  }
  if (fine && static_cast<int>(ticks.size()) > most) return logarithmic_ticks(scale, most, false);
  return ticks;
}

std::vector<double> linear_ticks(const ColorScale& scale, int most) {
  return multiples_within(scale.low, scale.high, round_up((scale.high - scale.low) / (most - 1)));
}

}  // namespace

ColorScale fitting_scale(const Eigen::VectorXd& values, bool logarithmic,
                         const ScaleChoice& choice) {
  const std::vector<double> shown = shown_values(values, logarithmic);
  if (shown.empty()) return {logarithmic ? 0.1 : 0, 1, logarithmic};
  double low = ranked(shown, choice.low_percent);
  double high = ranked(shown, choice.high_percent);
  if (choice.is_symmetric && !logarithmic && low < 0) {
    high = std::max(std::abs(low), std::abs(high));
    low = -high;
  }
  return logarithmic ? logarithmic_scale(low, high) : linear_scale(low, high);
}

double position_on(const ColorScale& scale, double value) {
  assert(scale.low < scale.high);
  if (!(value > scale.low)) return 0;
  const double position = scale.logarithmic
                              ? std::log(value / scale.low) / std::log(scale.high / scale.low)
                              : (value - scale.low) / (scale.high - scale.low);
  return std::min(position, 1.0);
}

double value_at(const ColorScale& scale, double position) {
  return scale.logarithmic ? scale.low * std::pow(scale.high / scale.low, position)
                           : scale.low + position * (scale.high - scale.low);
}

std::vector<double> tick_values(const ColorScale& scale, int most) {
  assert(most >= 2);
  std::vector<double> ticks =
      scale.logarithmic ? logarithmic_ticks(scale, most, true) : linear_ticks(scale, most);
  if (ticks.size() < 2) return {scale.low, scale.high};
  if (static_cast<int>(ticks.size()) <= most) return ticks;
  // Too many decades: every second, third ... of them.
  const std::size_t stride = (ticks.size() + most - 1) / most;
  std::vector<double> thinned;
  for (std::size_t k = 0; k < ticks.size(); k += stride) thinned.push_back(ticks[k]);
  return thinned;
}

}  // namespace io
