#include "io/light/number_stream.h"

#include <fmt/format.h>

#include <cmath>

namespace io {
namespace {

constexpr std::string_view kSeparators = " \t\r\v\f,\x1a";  // the last ends files of DOS

}  // namespace

std::string_view NumberStream::next_word() {
  for (;;) {
    const auto begin = rest_.find_first_not_of(kSeparators);
    if (begin != std::string_view::npos) {
      const auto end = std::min(rest_.find_first_of(kSeparators, begin), rest_.size());
      const std::string_view word = rest_.substr(begin, end - begin);
      rest_.remove_prefix(end);
      return word;
    }
    if (!lines_.next_line()) return {};
    rest_ = lines_.line();
  }
}

double NumberStream::next(std::string_view what) {
  const std::string_view word = next_word();
  if (word.empty()) fail(fmt::format("the file ends where {} is expected", what));
  const auto value = parse_number<double>(word);
  if (!value) fail(fmt::format("expected a number for {}, found {}", what, lines_.shown(word)));
  if (!std::isfinite(*value)) fail(fmt::format("{} is not finite: {}", what, lines_.shown(word)));
  return *value;
}

long NumberStream::next_count(std::string_view what, long least, long most) {
  const double value = next(what);
  if (value != std::floor(value) || !(value >= static_cast<double>(least)) ||
      !(value <= static_cast<double>(most))) {
    fail(fmt::format("found {} for {}, expected a whole number from {} to {}", value, what, least,
                     most));
  }
  return static_cast<long>(value);
}

std::vector<double> NumberStream::next_list(std::string_view what, long n) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(n));
  for (long k = 0; k < n; ++k) {
    values.push_back(next(fmt::format("{} {} of {}", what, k + 1, n)));
  }
  return values;
}

}  // namespace io
