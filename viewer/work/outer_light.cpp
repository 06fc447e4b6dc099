#include "viewer/work/outer_light.h"

#include <utility>

#include "radiosity/visibility/incident_light.h"
#include "radiosity/visibility/luminaire_light.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::Scene;

/// The light of each emitter that is made of luminaires.
void add_luminaires(const Scene& full, const radiosity::PatchMesh& mesh, const LightMix& mix,
                    const radiosity::Progress& progress, OuterLight& light) {
  std::vector<int> group(full.luminaires.size());
  std::vector<std::size_t> emitters;
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    if (mix.emitters[e].kind != Emitter::Kind::luminaires) continue;
    for (const int k : mix.emitters[e].luminaires) group[k] = static_cast<int>(emitters.size());
    emitters.push_back(e);
  }
  if (emitters.empty()) return;
  const radiosity::LuminaireLight luminaires(full, mesh);
  auto of_groups =
      luminaires.irradiance_of_groups(group, static_cast<Index>(emitters.size()), progress);
  for (std::size_t k = 0; k < emitters.size(); ++k) {
    light.irradiance[emitters[k]] =
        std::make_shared<const Eigen::MatrixXd>(std::move(of_groups[k].irradiance));
  }
}

/// The scene below its sun alone, or its sky alone.
Scene below(const Scene& full, Emitter::Kind kind) {
  Scene scene = full;
  scene.luminaires.clear();
  if (kind == Emitter::Kind::sky) scene.sun.reset();
  // A dark sky still has its ground, which the sun lights.
  if (kind == Emitter::Kind::sun && scene.sky) scene.sky->zenith_radiance.setZero();
  const bool has_ground = scene.sky && !scene.sky->ground_reflectance.isZero(0);
  if (kind == Emitter::Kind::sun && !has_ground) scene.sky.reset();
  return scene;
}

}  // namespace

std::shared_ptr<const OuterLight> outer_light(const Scene& scene, const radiosity::PatchMesh& mesh,
                                              const LightMix& mix,
                                              std::shared_ptr<const OuterLight> known,
                                              const radiosity::Progress& progress) {
  if (known && known->of.has_daylight_of(mix)) return known;
  const Scene full = with_reflectance(scene, mix);
  OuterLight light;
  light.of = mix;
  light.irradiance.resize(mix.emitters.size());
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const Emitter::Kind kind = mix.emitters[e].kind;
    if (kind == Emitter::Kind::luminaires && known) light.irradiance[e] = known->irradiance[e];
    if (kind != Emitter::Kind::sun && kind != Emitter::Kind::sky) continue;
    light.irradiance[e] = std::make_shared<const Eigen::MatrixXd>(
        radiosity::incident_irradiance(below(full, kind), mesh, progress));
  }
  if (!known) add_luminaires(full, mesh, mix, progress, light);
  return std::make_shared<const OuterLight>(std::move(light));
}

Eigen::MatrixXd mixed_irradiance(const OuterLight& light, const LightMix& mix) {
  Eigen::MatrixXd sum;
  for (std::size_t e = 0; e < light.irradiance.size(); ++e) {
    if (!light.irradiance[e]) continue;
    const double factor = mix.emitters[e].factor();
    if (sum.size() == 0) {
      sum = factor * *light.irradiance[e];
    } else if (factor > 0) {
      sum += factor * *light.irradiance[e];
    }
  }
  return sum;
}

}  // namespace viewer
