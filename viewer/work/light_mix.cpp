#include "viewer/work/light_mix.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <map>

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

Emission scaled(Emission emission, double factor) {
  if (factor == 0) return {};
  const bool is_temperature = emission.kind == Emission::Kind::temperature;
  emission.value *= is_temperature ? std::pow(factor, 0.25) : factor;
  return emission;
}

}  // namespace

bool LightMix::has_reflectance_of(const LightMix& other) const {
  return reflectance.size() == other.reflectance.size() &&
         std::equal(reflectance.begin(), reflectance.end(), other.reflectance.begin(),
                    [](const auto& a, const auto& b) { return a == b; });
}

LightMix make_mix(const Scene& scene) {
  LightMix mix;
  for (const Material& material : scene.materials) mix.reflectance.push_back(material.reflectance);
  std::vector<std::int32_t> emitting;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (emits(scene.materials[scene.surfaces[s].material])) {
      emitting.push_back(static_cast<std::int32_t>(s));
    }
  }
  if (emitting.size() <= kMostEmitters) {
    for (const std::int32_t s : emitting) {
      mix.emitters.push_back({.name = scene.surfaces[s].name, .surfaces = {s}});
    }
    return mix;
  }
  std::map<int, std::vector<std::int32_t>> of_material;
  for (const std::int32_t s : emitting) of_material[scene.surfaces[s].material].push_back(s);
  for (auto& [material, surfaces] : of_material) {
    mix.emitters.push_back(
        {.name = scene.materials[material].name, .surfaces = std::move(surfaces)});
  }
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
    result.materials[m].reflectance = mix.reflectance[m];
  }
  return result;
}

Scene mixed_scene(const Scene& scene, const LightMix& mix) {
  Scene result = with_reflectance(scene, mix);
  for (const Emitter& emitter : mix.emitters) {
    if (emitter.factor() == 1) continue;
    for (const std::int32_t s : emitter.surfaces) {
      Material material = result.materials[result.surfaces[s].material];
      material.emission = scaled(material.emission, emitter.factor());
      material.name += " of " + result.surfaces[s].name;
      result.surfaces[s].material = static_cast<int>(result.materials.size());
      result.materials.push_back(std::move(material));
    }
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
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const double factor = mix.emitters[e].factor();
    if (factor == 0) continue;
    sum.exitance += factor * lights.exitance[e];
    sum.irradiance += factor * lights.irradiance[e];
  }
  sum.radiosity = sum.exitance + sum.reflectance.cwiseProduct(sum.irradiance);
  return sum;
}

}  // namespace viewer
