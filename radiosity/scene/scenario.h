#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/scene/scene.h"

namespace radiosity {

/// Other light and other materials for the same surfaces. Names are patterns: * stands for any
/// letters, ? for one. Of several that match, the last counts.
struct Scenario {
  /// What surfaces and luminaires emit, in place of what the scene says: switched off ones can be
  /// switched on.
  struct Light {
    std::string surfaces;  ///< or luminaires
    double factor = 1;     ///< Surface::emission_factor, Luminaire::dimming, >= 0
  };
  /// What materials reflect, everywhere alike: in place of tables and textures.
  struct Paint {
    std::string materials;
    Eigen::VectorXd reflectance;  ///< in [0, 1], one value or one per band
  };
  std::string name;
  std::vector<Light> lights = {};
  std::vector<Paint> paints = {};
};

/// Whether the name is one that the pattern stands for.
bool matches(std::string_view pattern, std::string_view name);

/// The scene with the light and materials of a scenario; constant emissivities in place of tables
/// where it paints. Throws SceneError if a pattern stands for no surface that emits and no
/// luminaire, or for no material, if reflectances are not one per band, or 1 where heat is to be
/// given off.
Scene scene_of(const Scene& scene, const Scenario& scenario);

}  // namespace radiosity
