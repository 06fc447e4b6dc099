#include "viewer/work/light_mix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <map>
#include <utility>

#include "radiosity/scene/radiometry.h"

namespace viewer {
namespace {

using radiosity::Emission;
using radiosity::Index;
using radiosity::Material;
using radiosity::Scene;

bool emits(const Material& material) {
  return material.emission.kind != Emission::Kind::none && !material.emission.value.isZero(0);
}

/// As the file has it; what is off there is at full strength when it is switched on.
Emitter make_emitter(std::string name, std::vector<std::int32_t> surfaces, double factor) {
  return {.name = std::move(name),
          .surfaces = std::move(surfaces),
          .scale = factor > 0 ? factor : 1,
          .is_on = factor > 0};
}

/// One for each luminaire or, of many, for those of a photometric file that are dimmed alike.
void add_luminaires(const Scene& scene, LightMix& mix) {
  std::map<std::pair<int, double>, std::vector<int>> groups;
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    const radiosity::Luminaire& luminaire = scene.luminaires[k];
    const auto index = static_cast<int>(k);
    if (scene.luminaires.size() > kMostEmitters) {
      groups[{luminaire.photometry, luminaire.dimming}].push_back(index);
      continue;
    }
    mix.emitters.push_back(make_emitter(luminaire.name, {}, luminaire.dimming));
    mix.emitters.back().kind = Emitter::Kind::luminaires;
    mix.emitters.back().luminaires = {index};
  }
  for (const auto& [group, luminaires] : groups) {
    const auto& [photometry, dimming] = group;
    std::string name = scene.photometries[photometry].file.filename().string();
    if (dimming != 1) name += fmt::format(" ({:.3g} %)", 100 * dimming);
    mix.emitters.push_back(make_emitter(std::move(name), {}, dimming));
    mix.emitters.back().kind = Emitter::Kind::luminaires;
    mix.emitters.back().luminaires = luminaires;
  }
}

/// What is no lamp: they are at full strength as the file has them.
void add_daylight(const Scene& scene, LightMix& mix) {
  if (scene.sun) {
    mix.emitters.push_back({.name = "sun", .surfaces = {}, .kind = Emitter::Kind::sun});
  }
  if (scene.sky) {
    mix.emitters.push_back({.name = "sky", .surfaces = {}, .kind = Emitter::Kind::sky});
  }
}

/// Surfaces that are dimmed alike, by their material.
using Group = std::pair<int, double>;

/// The material, and how much is on if others of it are on otherwise.
std::string name_of(const Group& group, const std::map<Group, std::vector<std::int32_t>>& groups,
                    const Scene& scene) {
  const auto& [material, factor] = group;
  const auto n_alike = std::count_if(groups.begin(), groups.end(), [&](const auto& other) {
    return other.first.first == group.first;
  });
  const std::string& name = scene.materials[material].name;
  if (n_alike == 1 || factor == 1) return name;
  return factor == 0 ? name + " (off)" : fmt::format("{} ({:.3g} %)", name, 100 * factor);
}

}  // namespace

bool LightMix::has_reflectance_of(const LightMix& other) const {
  return reflectance.size() == other.reflectance.size() &&
         std::equal(reflectance.begin(), reflectance.end(), other.reflectance.begin(),
                    [](const auto& a, const auto& b) { return a == b; });
}

namespace {

bool is_same_sun(const radiosity::Sun& a, const radiosity::Sun& b) {
  return a.direction == b.direction && a.irradiance == b.irradiance;
}

bool is_same_sky(const radiosity::Sky& a, const radiosity::Sky& b) {
  const radiosity::SkyDistribution& p = a.distribution;
  const radiosity::SkyDistribution& q = b.distribution;
  return p.kind == q.kind && p.a == q.a && p.b == q.b && p.c == q.c && p.d == q.d && p.e == q.e &&
         (!p.needs_sun() || a.towards_sun == b.towards_sun) &&
         a.zenith_radiance == b.zenith_radiance && a.ground_reflectance == b.ground_reflectance &&
         a.up == b.up;
}

void add_surfaces(const Scene& scene, LightMix& mix) {
  std::vector<std::int32_t> emitting;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const int back = scene.surfaces[s].back_material;
    if (emits(scene.materials[scene.surfaces[s].material]) ||
        (back >= 0 && emits(scene.materials[back]))) {
      emitting.push_back(static_cast<std::int32_t>(s));
    }
  }
  if (emitting.size() <= kMostEmitters) {
    for (const std::int32_t s : emitting) {
      const radiosity::Surface& surface = scene.surfaces[s];
      mix.emitters.push_back(make_emitter(surface.name, {s}, surface.emission_factor));
    }
    return;
  }
  std::map<Group, std::vector<std::int32_t>> groups;
  for (const std::int32_t s : emitting) {
    const radiosity::Surface& surface = scene.surfaces[s];
    groups[{surface.material, surface.emission_factor}].push_back(s);
  }
  for (const auto& [group, surfaces] : groups) {
    mix.emitters.push_back(make_emitter(name_of(group, groups, scene), surfaces, group.second));
  }
}

}  // namespace

bool LightMix::has_daylight_of(const LightMix& other) const {
  const bool has_same_kinds =
      sun.has_value() == other.sun.has_value() && sky.has_value() == other.sky.has_value();
  if (!has_same_kinds) return false;
  return (!sun || is_same_sun(*sun, *other.sun)) && (!sky || is_same_sky(*sky, *other.sky));
}

LightMix make_mix(const Scene& scene) {
  LightMix mix;
  mix.sun = scene.sun;
  mix.sky = scene.sky;
  for (const Material& material : scene.materials) mix.reflectance.push_back(material.reflectance);
  add_surfaces(scene, mix);
  add_luminaires(scene, mix);
  add_daylight(scene, mix);
  return mix;
}

std::optional<std::size_t> emitter_named(const LightMix& mix, const std::string& name) {
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    if (mix.emitters[e].name == name) return e;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool is_index = error == std::errc() && end == name.data() + name.size();
  if (is_index && index < mix.emitters.size()) return index;
  return std::nullopt;
}

Eigen::VectorXd with_mean_reflectance(const Eigen::VectorXd& original, double mean) {
  if (original.isZero(0)) return Eigen::VectorXd::Constant(original.size(), mean);
  Eigen::VectorXd result = original * (mean / original.mean());
  // What one band cannot take goes to the others, until all are full.
  for (Index pass = 0; pass < result.size() && result.maxCoeff() > 1; ++pass) {
    result = result.cwiseMin(1);
    double others = 0;
    double full = 0;
    for (const double value : result) (value < 1 ? others : full) += value;
    if (!(others > 0)) break;
    const double factor = (mean * static_cast<double>(result.size()) - full) / others;
    for (double& value : result) value = value < 1 ? value * factor : 1;
  }
  return result.cwiseMin(1);
}

Scene with_reflectance(const Scene& scene, const LightMix& mix) {
  Scene result = scene;
  for (std::size_t m = 0; m < result.materials.size(); ++m) {
    radiosity::Material& material = result.materials[m];
    if (material.reflectance != mix.reflectance[m]) material.texture.reset();  // painted over
    material.reflectance = mix.reflectance[m];
  }
  for (radiosity::Surface& surface : result.surfaces) surface.emission_factor = 1;
  for (radiosity::Luminaire& luminaire : result.luminaires) luminaire.dimming = 1;
  result.sun = mix.sun;
  result.sky = mix.sky;
  return result;
}

Scene mixed_scene(const Scene& scene, const LightMix& mix) {
  Scene result = with_reflectance(scene, mix);
  for (const Emitter& emitter : mix.emitters) {
    for (const std::int32_t s : emitter.surfaces) {
      result.surfaces[s].emission_factor = emitter.factor();
    }
    for (const int k : emitter.luminaires) result.luminaires[k].dimming = emitter.factor();
    if (emitter.kind == Emitter::Kind::sun) result.sun->irradiance *= emitter.factor();
    if (emitter.kind == Emitter::Kind::sky) result.sky->zenith_radiance *= emitter.factor();
  }
  return result;
}

Eigen::MatrixXd emitter_exitance(const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& exitance,
                                 const Emitter& emitter) {
  std::vector<bool> is_of_emitter(mesh.surface_names.size());
  for (const std::int32_t s : emitter.surfaces) is_of_emitter[s] = true;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(exitance.rows(), exitance.cols());
  for (Index i = 0; i < mesh.size(); ++i) {
    if (is_of_emitter[mesh.surface[i]]) result.row(i) = exitance.row(i);
  }
  return result;
}

Eigen::MatrixXd mix_exitance(const Scene& scene, const radiosity::PatchMesh& mesh,
                             const LightMix& mix) {
  const Eigen::MatrixXd full = radiosity::exitance(scene, mesh);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(full.rows(), full.cols());
  for (const Emitter& emitter : mix.emitters) {
    if (emitter.factor() > 0) result += emitter.factor() * emitter_exitance(mesh, full, emitter);
  }
  return result;
}

radiosity::Solution superpose(const EmitterLights& lights, const LightMix& mix) {
  assert(lights.irradiance.size() == mix.emitters.size());
  radiosity::Solution sum;
  sum.reflectance = lights.reflectance;
  sum.exitance = Eigen::MatrixXd::Zero(lights.reflectance.rows(), lights.reflectance.cols());
  sum.irradiance = sum.exitance;
  if (lights.from_without.size() > 0) sum.irradiance = lights.from_without;
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const double factor = mix.emitters[e].factor();
    if (factor == 0) continue;
    if (lights.exitance[e].size() > 0) sum.exitance += factor * lights.exitance[e];
    sum.irradiance += factor * lights.irradiance[e];
  }
  sum.radiosity = sum.exitance + sum.reflectance.cwiseProduct(sum.irradiance);
  return sum;
}

}  // namespace viewer
