#include "io/base/rounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace io {
namespace {

using radiosity::Vec3;

constexpr std::size_t kSampledPoints = 20'000 / 3;
/// Most of the scene's size that rounding is taken for.
constexpr double kLargestShare = 1e-5;
constexpr int kFewestDigits = 5;
constexpr int kMostDigits = 12;
constexpr int kDigitsOfDouble = 17;
/// Decimals of up to seven digits are as near to a float as to each other.
constexpr int kDigitsBeyondSingle = 8;
/// Up to nine digits tell floats apart: they are what programs print them with.
constexpr int kDigitsOfSingle = 9;
constexpr int kLeastCount = 6;

/// A number as the fewest digits that bring it back.
struct Decimal {
  double value;
  int n_digits;
  int place;  ///< of the last digit: 10^place
};

Decimal shortest_decimal(double value) {
  std::array<char, 32> text{};
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific)
          .ptr;
  char* const e = std::find(text.data(), end, 'e');
  const auto length = static_cast<int>(e - text.data());
  const int n_digits = length > 1 ? length - 1 : 1;  // without the point
  return {value, n_digits, std::atoi(e + 1) - (n_digits - 1)};
}

/// The distinct magnitudes above 0 among coordinates from all over the points, increasing.
std::vector<Decimal> magnitudes(std::span<const Vec3> points) {
  const std::size_t step = points.size() / kSampledPoints + 1;
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); i += step) {
    for (const double x : points[i]) {
      if (x != 0) values.push_back(std::abs(x));
    }
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<Decimal> result;
  for (const double value : values) result.push_back(shortest_decimal(value));
  return result;
}

double half_unit(int place) { return 0.5 * std::pow(10.0, place); }

/// Half a unit in the last place of a float of this size, at most.
double half_unit_of_single(double value) { return std::ldexp(value, -24); }

/// Whether the number is a float, or the digits that one is printed with.
bool is_single(const Decimal& number) {
  const double difference = std::abs(number.value - static_cast<double>(float(number.value)));
  return difference == 0 ||
         (number.n_digits <= kDigitsOfSingle && difference <= 1.001 * half_unit(number.place));
}

/// Of the numbers with more digits than single precision decides about; 0 if they are none.
double rounding_to_single(std::span<const Decimal> numbers) {
  constexpr double kShare = 0.95;
  double largest = 0;
  double n_long = 0;
  double n_single = 0;
  for (const Decimal& number : numbers) {
    if (number.n_digits < kDigitsBeyondSingle) continue;
    ++n_long;
    if (!is_single(number)) continue;
    ++n_single;
    largest = std::max(largest, number.value);
  }
  return n_long > 0 && n_single >= kShare * n_long ? half_unit_of_single(largest) : 0;
}

/// Half a unit of the last digit that large numbers of `n_digits` have. One of fifty may be larger:
/// a number that was not rounded and happens to have as many.
double rounding_of(std::span<const Decimal> numbers, int n_digits) {
  std::vector<int> places;
  for (const Decimal& number : numbers) {
    if (number.n_digits == n_digits) places.push_back(number.place);
  }
  std::sort(places.begin(), places.end());
  const std::size_t n = places.size();
  return half_unit(places[std::min(n - n / 50, n - 1) - 1]);
}

double rounding_to_decimals(std::span<const Decimal> numbers) {
  std::array<int, kDigitsOfDouble + 1> count{};
  for (const Decimal& number : numbers) ++count[std::min(number.n_digits, kDigitsOfDouble)];
  int n_longer = 0;
  for (int n_digits = kDigitsOfDouble; n_digits >= kFewestDigits; --n_digits) {
    const int n = count[n_digits];
    if (n_digits <= kMostDigits && n >= kLeastCount && 3 * n >= n_longer) {
      return rounding_of(numbers, n_digits);
    }
    n_longer += n;
  }
  return 0;
}

Rounding limited(double of_digits, std::span<const Vec3> points) {
  radiosity::Box3 box;
  for (const Vec3& point : points) box.extend(point);
  const double size = box.isEmpty() ? 0 : box.diagonal().stableNorm();
  return {std::min(of_digits, kLargestShare * size), of_digits};
}

}  // namespace

Rounding found_rounding(std::span<const Vec3> points) {
  const std::vector<Decimal> numbers = magnitudes(points);
  const double single = rounding_to_single(numbers);
  return limited(single > 0 ? single : rounding_to_decimals(numbers), points);
}

Rounding single_rounding(std::span<const Vec3> points, double quantised) {
  const std::vector<Decimal> numbers = magnitudes(points);
  const bool is_exact = std::all_of(numbers.begin(), numbers.end(), [](const Decimal& number) {
    return number.n_digits < kFewestDigits;
  });
  const double single = is_exact ? 0 : half_unit_of_single(numbers.back().value);
  return limited(std::max(single, quantised), points);
}

std::optional<std::string> rounding_warning(const Rounding& rounding) {
  if (rounding.of_digits <= 10 * rounding.precision) return std::nullopt;
  return fmt::format(
      "the coordinates are rounded to {:.1g} of their unit, which is coarse for the size of what "
      "they "
      "describe; move it to the origin before its digits are cut",
      rounding.of_digits);
}

}  // namespace io
