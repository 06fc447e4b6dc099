#include "radiosity/scene/scenario.h"

#include "radiosity/base/error.h"
#include "radiosity/scene/emissivity_table.h"

namespace radiosity {
namespace {

[[noreturn]] void refuse_scenario(const Scenario& scenario, const std::string& reason) {
  throw SceneError("scenario '" + scenario.name + "': " + reason);
}

void paint(const Scenario& scenario, const Scenario::Paint& paint, Scene& scene) {
  bool is_found = false;
  for (Material& material : scene.materials) {
    if (!matches(paint.materials, material.name)) continue;
    is_found = true;
    if (paint.reflectance.size() != 1 && paint.reflectance.size() != scene.bands.count()) {
      refuse_scenario(scenario,
                      "found " + std::to_string(paint.reflectance.size()) + " reflectances of '" +
                          paint.materials + "', expected 1" +
                          (scene.bands.count() > 1 ? " or " + std::to_string(scene.bands.count())
                                                   : std::string()));
    }
    if (needs_emissivity(material.emission) && paint.reflectance.minCoeff() == 1) {
      refuse_scenario(scenario, "the reflectance 1 of '" + material.name +
                                    "', which has a temperature or heat that it cannot give off "
                                    "then; expected less");
    }
    material.emissivity_table.clear();
    material.texture.reset();
    material.reflectance =
        paint.reflectance.size() == 1
            ? Eigen::VectorXd::Constant(scene.bands.count(), paint.reflectance[0]).eval()
            : paint.reflectance;
  }
  if (!is_found) refuse_scenario(scenario, "there is no material '" + paint.materials + "'");
}

bool is_emitting(const Scene& scene, int material) {
  return material >= 0 && scene.materials[material].emission.kind != Emission::Kind::none;
}

void light(const Scenario& scenario, const Scenario::Light& light, Scene& scene) {
  bool is_found = false;
  for (Surface& surface : scene.surfaces) {
    const bool emits =
        is_emitting(scene, surface.material) || is_emitting(scene, surface.back_material);
    if (!emits || !matches(light.surfaces, surface.name)) continue;
    is_found = true;
    surface.emission_factor = light.factor;
  }
  for (Luminaire& luminaire : scene.luminaires) {
    if (!matches(light.surfaces, luminaire.name)) continue;
    is_found = true;
    luminaire.dimming = light.factor;
  }
  if (!is_found) {
    refuse_scenario(
        scenario, "there is no surface '" + light.surfaces + "' that emits, nor such a luminaire");
  }
}

}  // namespace

bool matches(std::string_view pattern, std::string_view name) {
  // The last star, and where the name goes on if it stands for one letter more.
  std::size_t star = std::string_view::npos;
  std::size_t resumed = 0;
  std::size_t p = 0;
  for (std::size_t n = 0; n < name.size();) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resumed = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resumed;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

Scene scene_of(const Scene& scene, const Scenario& scenario) {
  Scene result = scene;
  for (const Scenario::Paint& rule : scenario.paints) paint(scenario, rule, result);
  for (const Scenario::Light& rule : scenario.lights) light(scenario, rule, result);
  return result;
}

}  // namespace radiosity
