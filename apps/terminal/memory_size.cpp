#include "apps/terminal/memory_size.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace apps {
namespace {

constexpr std::string_view kSizePrefixes = "kmgt";
constexpr double kMostBytes = 1e18;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The factor of a unit such as "GB", "Gi" or ""; nothing if there is no such unit.
std::optional<double> unit_factor(std::string unit) {
  for (char& c : unit) c = lower(c);
  if (!unit.empty() && unit.back() == 'b') unit.pop_back();
  if (unit.empty()) return 1;
  const std::size_t prefix = kSizePrefixes.find(unit.front());
  const bool is_binary = unit.substr(1) == "i";
  if (prefix == std::string_view::npos || (unit.size() > 1 && !is_binary)) return std::nullopt;
  return std::pow(is_binary ? 1024.0 : 1000.0, static_cast<double>(prefix + 1));
}

}  // namespace

std::optional<std::size_t> parse_memory_size(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  std::string unit(end, text.data() + text.size());
  if (!unit.empty() && unit.front() == ' ') unit.erase(0, 1);
  const double bytes = number * unit_factor(unit).value_or(0);
  if (!(bytes >= 1 && bytes <= kMostBytes)) return std::nullopt;
  return static_cast<std::size_t>(bytes);
}

std::string check_memory_size(const std::string& text) {
  if (parse_memory_size(text)) return "";
  return fmt::format("found '{}', expected a size such as 2GB, 500MB or 750MiB", text);
}

}  // namespace apps
