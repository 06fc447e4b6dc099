#include "radiosity/scene/celsius.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace radiosity {
namespace {

/// What is kept that cold is not kept by walls of 10 K and more alone.
constexpr double kLeastCelsius = 10;
constexpr double kMostCelsius = 60;

}  // namespace

std::optional<std::string> celsius_warning(std::span<const double> kelvins) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (const double kelvin : kelvins) {
    if (kelvin == 0 || std::isnan(kelvin)) continue;
    low = std::min(low, kelvin);
    high = std::max(high, kelvin);
  }
  if (!(high > 0 && low >= kLeastCelsius && high <= kMostCelsius)) return std::nullopt;
  std::ostringstream text;
  text << "all temperatures lie from " << low << " to " << high
       << " K: are they degrees Celsius? Kelvin is expected, 273.15 more";
  return text.str();
}

}  // namespace radiosity
