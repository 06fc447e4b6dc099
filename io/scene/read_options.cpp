#include "io/scene/read_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "radiosity/base/error.h"

namespace io {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 7> kUnits = {{
    {"m", 1},
    {"mm", 1e-3},
    {"cm", 1e-2},
    {"in", 0.0254},
    {"ft", 0.3048},
    {"km", 1e3},
    {"um", 1e-6},
}};

}  // namespace

double metres_per_unit(const std::string& unit) {
  std::vector<std::string_view> names;
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return metres;
    names.push_back(name);
  }
  throw radiosity::SceneError(
      fmt::format("unknown unit \"{}\", expected one of {}", unit, fmt::join(names, ", ")));
}

}  // namespace io
