#include "viewer/work/lamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/surface_flux.h"

namespace viewer {
namespace {

/// A name that no material has.
std::string free_material_name(const radiosity::Scene& scene, const std::string& wanted) {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const radiosity::Material& other) { return other.name == name; });
  };
  std::string name = wanted;
  for (int k = 2; is_taken(name); ++k) name = fmt::format("{} {}", wanted, k);
  return name;
}

}  // namespace

radiosity::Scene with_lamp(const radiosity::Scene& scene, std::int32_t surface, double lumens) {
  if (surface < 0 || static_cast<std::size_t>(surface) >= scene.surfaces.size()) {
    throw std::out_of_range(
        fmt::format("there is no surface {}; the scene has {}", surface, scene.surfaces.size()));
  }
  if (!(lumens > 0) || !std::isfinite(lumens)) {
    throw std::out_of_range(fmt::format("a lamp needs more than 0 lumens, found {}", lumens));
  }
  if (radiosity::is_thermal(scene)) {
    throw radiosity::SceneError("the scene's light is heat, which has no lumens");
  }
  const double per_watt = radiosity::luminous_weights(scene.bands).sum();
  if (!(per_watt > 0)) {
    throw radiosity::SceneError("the scene's bands have no light that is seen");
  }
  radiosity::Scene result = scene;
  radiosity::Surface& lamp = result.surfaces[surface];
  radiosity::Material material = result.materials[lamp.material];
  material.name = free_material_name(scene, lamp.name + " lamp");
  material.emission = {.kind = radiosity::Emission::Kind::power,
                       .value = Eigen::VectorXd::Constant(scene.bands.count(), lumens / per_watt)};
  lamp.material = static_cast<int>(result.materials.size());
  lamp.emission_factor = 1;
  result.materials.push_back(std::move(material));
  return result;
}

}  // namespace viewer
