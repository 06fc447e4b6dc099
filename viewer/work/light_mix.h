#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace viewer {

/// Something that gives light and can be dimmed: a surface, a luminaire, or in scenes with many
/// lamps all surfaces of a material or all luminaires of a photometric file; the sun; the sky.
struct Emitter {
  enum class Kind { surfaces, luminaires, sun, sky };
  std::string name;
  std::vector<std::int32_t> surfaces;  ///< of Kind::surfaces
  double scale = 1;                    ///< of what it emits, >= 0
  bool is_on = true;
  Kind kind = Kind::surfaces;
  std::vector<int> luminaires = {};  ///< of Kind::luminaires: indices into Scene::luminaires

  [[nodiscard]] double factor() const { return is_on ? scale : 0; }
};

/// More emitting surfaces than this are taken together by material, more luminaires by file.
inline constexpr std::size_t kMostEmitters = 48;

/// What a person changes about a scene's light: the emitters' strength, the materials' reflectance,
/// where the sun stands and what the sky is like.
struct LightMix {
  std::vector<Emitter> emitters;
  std::optional<radiosity::Sun> sun = {};    ///< at full strength
  std::optional<radiosity::Sky> sky = {};    ///< likewise
  std::vector<Eigen::VectorXd> reflectance;  ///< per material, per band, in [0, 1]

  /// Whether the reflectances are those of the other mix.
  [[nodiscard]] bool has_reflectance_of(const LightMix& other) const;
  /// Whether its sun and sky at full strength are those of the other mix.
  [[nodiscard]] bool has_daylight_of(const LightMix& other) const;
};

/// The scene as it is in its file; lamps that are off there are off.
LightMix make_mix(const radiosity::Scene& scene);

/// Index of the emitter of that name, or whose index it is; empty if there is none.
std::optional<std::size_t> emitter_named(const LightMix& mix, const std::string& name);

/// A reflectance whose mean over the bands is `mean` in [0, 1]: all bands scaled alike, as far as
/// none exceeds 1; grey if the original is black.
Eigen::VectorXd with_mean_reflectance(const Eigen::VectorXd& original, double mean);

/// The scene with the mix's reflectances, sun and sky and all emitters at full strength.
radiosity::Scene with_reflectance(const radiosity::Scene& scene, const LightMix& mix);

/// The scene as the mix has it, to solve afresh or to save.
radiosity::Scene mixed_scene(const radiosity::Scene& scene, const LightMix& mix);

/// Rows of `exitance` (n x b) of one emitter's patches, 0 elsewhere, at full strength.
Eigen::MatrixXd emitter_exitance(const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& exitance,
                                 const Emitter& emitter);

/// Exitance of the mix on the patches, W/m², n x b. `scene` has its reflectances.
Eigen::MatrixXd mix_exitance(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                             const LightMix& mix);

/// The light of each emitter alone, at full strength, for one choice of reflectances. Since light
/// adds up, any mix of the emitters is a weighted sum.
struct EmitterLights {
  /// Per emitter: M_e, W/m², n x b; empty for those that are no surfaces.
  std::vector<Eigen::MatrixXd> exitance;
  std::vector<Eigen::MatrixXd> irradiance;  ///< per emitter: H, W/m², n x b
  Eigen::MatrixXd reflectance;              ///< n x b
  Eigen::MatrixXd from_without;  ///< H of the environment alone, in each mix, n x b; or empty
};

/// Exitance, irradiance and radiosity of the mix; takes as many additions as there are values.
/// Errors and energy are left empty.
radiosity::Solution superpose(const EmitterLights& lights, const LightMix& mix);

}  // namespace viewer
