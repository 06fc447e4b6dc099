#include "io/picture/color_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "io/picture/round_numbers.h"

namespace io {
namespace {

constexpr double kMostDecades = 6;
// Rounding of a quotient that should be whole.
constexpr double kRounding = 1e-9;

// Every fifteenth of the 256 colours; linear between them, which is within about 5 of 255.
constexpr std::array<std::array<double, 3>, 18> kViridis = {{{0.2670, 0.0049, 0.3294},
                                                             {0.2819, 0.0897, 0.4124},
                                                             {0.2803, 0.1657, 0.4765},
                                                             {0.2637, 0.2376, 0.5188},
                                                             {0.2374, 0.3052, 0.5419},
                                                             {0.2086, 0.3678, 0.5527},
                                                             {0.1823, 0.4262, 0.5571},
                                                             {0.1592, 0.4822, 0.5581},
                                                             {0.1378, 0.5375, 0.5549},
                                                             {0.1211, 0.5927, 0.5446},
                                                             {0.1281, 0.6477, 0.5235},
                                                             {0.1807, 0.7014, 0.4882},
                                                             {0.2741, 0.7520, 0.4366},
                                                             {0.3952, 0.7975, 0.3678},
                                                             {0.5356, 0.8358, 0.2819},
                                                             {0.6889, 0.8654, 0.1827},
                                                             {0.8456, 0.8873, 0.0997},
                                                             {0.9932, 0.9062, 0.1439}}};

// Every second of the 33 colours that ParaView has.
constexpr std::array<std::array<double, 3>, 17> kCoolWarm = {{{0.2298, 0.2987, 0.7537},
                                                              {0.3039, 0.4065, 0.8450},
                                                              {0.3830, 0.5094, 0.9174},
                                                              {0.4667, 0.6046, 0.9682},
                                                              {0.5530, 0.6889, 0.9954},
                                                              {0.6392, 0.7596, 0.9982},
                                                              {0.7222, 0.8140, 0.9766},
                                                              {0.7987, 0.8498, 0.9317},
                                                              {0.8654, 0.8654, 0.8654},
                                                              {0.9241, 0.8274, 0.7745},
                                                              {0.9589, 0.7698, 0.6780},
                                                              {0.9700, 0.6943, 0.5794},
                                                              {0.9580, 0.6028, 0.4818},
                                                              {0.9239, 0.4973, 0.3880},
                                                              {0.8692, 0.3783, 0.3003},
                                                              {0.7956, 0.2413, 0.2205},
                                                              {0.7057, 0.0156, 0.1502}}};

/// The finite values, and of them only those above 0 if `logarithmic`, sorted.
std::vector<double> shown_values(const Eigen::VectorXd& values, bool logarithmic) {
  std::vector<double> shown;
  std::copy_if(values.begin(), values.end(), std::back_inserter(shown),
               [&](double value) { return std::isfinite(value) && (!logarithmic || value > 0); });
  std::sort(shown.begin(), shown.end());
  return shown;
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

ColorScale fitting_scale(const Eigen::VectorXd& values, bool logarithmic) {
  const std::vector<double> shown = shown_values(values, logarithmic);
  if (shown.empty()) return {logarithmic ? 0.1 : 0, 1, logarithmic};
  const auto rank = static_cast<std::size_t>(0.98 * static_cast<double>(shown.size() - 1));
  const double high = shown[rank];
  return logarithmic ? logarithmic_scale(shown.front(), high) : linear_scale(shown.front(), high);
}

double position_on(const ColorScale& scale, double value) {
  assert(scale.low < scale.high);
  if (!(value > scale.low)) return 0;
  const double position = scale.logarithmic
                              ? std::log(value / scale.low) / std::log(scale.high / scale.low)
                              : (value - scale.low) / (scale.high - scale.low);
  return std::min(position, 1.0);
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

Rgb map_color(double position, ColorMap map) {
  const auto colors = map == ColorMap::cool_warm ? std::span<const std::array<double, 3>>(kCoolWarm)
                                                 : std::span<const std::array<double, 3>>(kViridis);
  const double place = std::clamp(position, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), colors.size() - 2);
  const double t = place - static_cast<double>(k);
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = (1 - t) * colors[k][c] + t * colors[k + 1][c];
    color[c] = static_cast<std::uint8_t>(std::lround(255 * value));
  }
  return color;
}

}  // namespace io
