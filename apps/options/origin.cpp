#include "apps/options/origin.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <vector>

#include "apps/options/surface_names.h"
#include "apps/terminal/number_list.h"
#include "radiosity/base/error.h"

namespace apps {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw CLI::ValidationError(
      "--from", reason + "; expected the name of a surface or x,y,z,nx,ny,nz (metres, normal)");
}

PointOrigin parse_point(const std::vector<std::string>& fields) {
  std::vector<double> numbers;
  for (const std::string& field : fields) {
    const auto number = as_number(field);
    if (!number) refuse(fmt::format("'{}' is not a number", field));
    numbers.push_back(*number);
  }
  if (numbers.size() != 6) refuse(fmt::format("found {} numbers", numbers.size()));
  const radiosity::Vec3 normal(numbers[3], numbers[4], numbers[5]);
  const double length = normal.stableNorm();
  if (!(length > 0)) refuse("the normal is zero");
  return {{numbers[0], numbers[1], numbers[2]}, normal / length};
}

[[noreturn]] void refuse_name(const std::string& name, const radiosity::Scene& scene) {
  throw radiosity::SceneError(fmt::format("{}: there is no surface '{}', the nearest is '{}'",
                                          scene.source, name, nearest_surface(scene, name)));
}

}  // namespace

Origin parse_origin(const std::string& text, const radiosity::Scene& scene) {
  const auto surface = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                    [&](const auto& known) { return known.name == text; });
  if (surface != scene.surfaces.end()) {
    return static_cast<std::int32_t>(surface - scene.surfaces.begin());
  }
  const std::vector<std::string> fields = split_at_commas(text);
  if (fields.size() < 2 || !as_number(fields.front())) refuse_name(text, scene);
  return parse_point(fields);
}

}  // namespace apps
