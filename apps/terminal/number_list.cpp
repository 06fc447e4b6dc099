#include "apps/terminal/number_list.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cmath>

namespace apps {

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::optional<double> as_number(const std::string& text) {
  double value = 0;
  const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::optional<std::vector<double>> as_numbers(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& field : split_at_commas(text)) {
    const auto number = as_number(field);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

std::string check_positive(const std::string& text) {
  const auto value = as_number(text);
  if (value && *value > 0) return "";
  return fmt::format("found '{}', expected a number above 0", text);
}

std::string check_share(const std::string& text) {
  double value = 0;
  if (CLI::detail::lexical_cast(text, value) && value > 0 && value < 1) return "";
  return fmt::format("found '{}', expected a number above 0 and below 1", text);
}

}  // namespace apps
