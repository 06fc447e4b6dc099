#include "apps/validation/plot/axis_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/picture/round_numbers.h"

namespace apps::validation {
namespace {

constexpr int kMostTicks = 6;
/// Room between the outermost values and the ends of the axis, relative to what it spans.
constexpr double kRoom = 0.04;

std::vector<double> linear_ticks(double low, double high) {
  return io::multiples_within(low, high, io::round_up((high - low) / kMostTicks));
}

/// Ticks between two logarithms to base 10.
std::vector<double> logarithmic_ticks(double low, double high) {
  const auto first = static_cast<int>(std::floor(low));
  const auto last = static_cast<int>(std::ceil(high));
  const bool is_wide = high - low >= 2;
  const int stride = std::max(1, static_cast<int>(std::ceil((high - low) / (kMostTicks + 1))));
  const std::vector<double> factors = is_wide ? std::vector{1.} : std::vector{1., 2., 5.};
  std::vector<double> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    if (is_wide && exponent % stride != 0) continue;
    for (const double factor : factors) {
      const double tick = std::log10(factor) + exponent;
      if (tick >= low - 1e-9 && tick <= high + 1e-9) {
        ticks.push_back(factor * std::pow(10, exponent));
      }
    }
  }
  return ticks;
}

std::string superscript(int number) {
  constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

}  // namespace

double AxisRange::position(double value) const {
  if (scale == Axis::Scale::linear) return (value - low) / (high - low);
  return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
}

bool AxisRange::shows(double value) const {
  return std::isfinite(value) && (scale == Axis::Scale::linear || value > 0);
}

AxisRange make_range(Axis::Scale scale, const std::vector<double>& values) {
  const bool is_linear = scale == Axis::Scale::linear;
  AxisRange range{scale};
  double low = 0;
  double high = 1;
  bool is_first = true;
  for (const double value : values) {
    if (!range.shows(value)) continue;
    const double shown = is_linear ? value : std::log10(value);
    low = is_first ? shown : std::min(low, shown);
    high = is_first ? shown : std::max(high, shown);
    is_first = false;
  }
  if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const double half = is_linear && high != 0 ? 0.1 * std::abs(high) : 0.5;
    low -= half;
    high += half;
  }
  const double room = kRoom * (high - low);
  // An axis that starts at 0 stays there.
  const bool keeps_zero = is_linear && low == 0;
  low -= keeps_zero ? 0 : room;
  high += room;
  if (!is_linear) {
    low = std::max<double>(low, std::numeric_limits<double>::min_exponent10);
    high = std::min<double>(high, std::numeric_limits<double>::max_exponent10);
  }
  range.ticks = is_linear ? linear_ticks(low, high) : logarithmic_ticks(low, high);
  range.low = is_linear ? low : std::pow(10, low);
  range.high = is_linear ? high : std::pow(10, high);
  return range;
}

std::string tick_text(double value, Axis::Scale scale) {
  if (scale == Axis::Scale::logarithmic && (value < 0.99e-3 || value > 9999)) {
    const auto exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    const double factor = std::round(value / std::pow(10, exponent));
    return factor == 1 ? "10" + superscript(exponent)
                       : fmt::format("{:g}·10{}", factor, superscript(exponent));
  }
  return fmt::format("{:.6g}", std::abs(value) < 1e-14 ? 0 : value);
}

}  // namespace apps::validation
