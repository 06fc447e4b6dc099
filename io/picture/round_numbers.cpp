#include "io/picture/round_numbers.h"

#include <cmath>

namespace io {
namespace {

// Rounding of a quotient that should be whole.
constexpr double kSlack = 1e-9;

}  // namespace

double round_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + kSlack));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= value * (1 - kSlack)) return digit * power;
  }
  return 10 * power;
}

double round_down(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + kSlack));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value * (1 + kSlack)) return digit * power;
  }
  return power;
}

std::vector<double> multiples_within(double low, double high, double step) {
  std::vector<double> multiples;
  const double first = std::ceil(low / step - kSlack);
  const double last = std::floor(high / step + kSlack);
  for (double k = first; k <= last; ++k) multiples.push_back(k * step);
  return multiples;
}

}  // namespace io
