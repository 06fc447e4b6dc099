#include "viewer/desk/surface_groups.h"

#include <algorithm>

namespace viewer {
namespace {

void add(std::optional<double>& sum, const std::optional<double>& value, double factor = 1) {
  if (value) sum = sum.value_or(0) + factor * *value;
}

}  // namespace

std::vector<SurfaceGroup> material_groups(const radiosity::Scene& scene) {
  std::vector<SurfaceGroup> groups;
  for (const radiosity::Material& material : scene.materials) {
    groups.push_back({.index = groups.size(), .name = material.name, .surfaces = {}});
  }
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    groups[scene.surfaces[s].material].surfaces.push_back(static_cast<std::int32_t>(s));
  }
  return groups;
}

std::vector<SurfaceGroup> lamp_groups(const LightMix& mix) {
  std::vector<SurfaceGroup> groups;
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const Emitter& emitter = mix.emitters[e];
    if (emitter.kind == Emitter::Kind::sun || emitter.kind == Emitter::Kind::sky) continue;
    groups.push_back({.index = e, .name = emitter.name, .surfaces = emitter.surfaces});
    std::sort(groups.back().surfaces.begin(), groups.back().surfaces.end());
  }
  return groups;
}

SurfaceTotal group_total(const SurfaceGroup& group, const std::vector<SurfaceTotal>& totals) {
  SurfaceTotal sum{.name = group.name};
  for (const SurfaceTotal& total : totals) {
    if (!std::binary_search(group.surfaces.begin(), group.surfaces.end(), total.surface)) continue;
    sum.material = total.material;
    sum.n_patches += total.n_patches;
    sum.area += total.area;
    add(sum.flux, total.flux);
    add(sum.irradiance, total.irradiance, total.area);
    add(sum.heat, total.heat);
  }
  if (group.lumens) sum.flux = group.lumens;
  if (sum.irradiance && sum.area > 0) *sum.irradiance /= sum.area;
  return sum;
}

}  // namespace viewer
