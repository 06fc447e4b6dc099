#include "io/scene/sky_writer.h"

#include <vector>

#include "io/scene/point_json.h"

namespace io {
namespace {

using radiosity::SkyDistribution;

/// Always a list: one number would be shared among bands of heat.
Json list_json(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

Json distribution_json(const SkyDistribution& sky) {
  if (sky.kind == SkyDistribution::Kind::overcast) return {{"form", "overcast"}};
  const char* form = sky.kind == SkyDistribution::Kind::cie ? "cie" : "perez";
  return {{"form", form}, {"a", sky.a}, {"b", sky.b}, {"c", sky.c}, {"d", sky.d}, {"e", sky.e}};
}

}  // namespace

Json sky_json(const radiosity::Scene& scene) {
  const radiosity::Sky& sky = *scene.sky;
  Json json = {{"distribution", distribution_json(sky.distribution)},
               {"zenith_radiance", list_json(sky.zenith_radiance)},
               {"ground_reflectance", list_json(sky.ground_reflectance)},
               {"up", point_json(sky.up)}};
  if (sky.north) json["north"] = point_json(*sky.north);
  // The scene's sun tells where it is for both.
  if (!scene.sun) json["direction"] = point_json(-sky.towards_sun);
  return json;
}

Json glazing_json(const radiosity::Glazing& glazing) {
  if (glazing.refractive_index == 0) return {{"transmittance", list_json(glazing.transmittance)}};
  Json json = {{"refractive_index", glazing.refractive_index},
               {"internal_transmittance", list_json(glazing.transmittance)}};
  if (glazing.is_by_thickness) json["by_thickness"] = true;
  return json;
}

}  // namespace io
