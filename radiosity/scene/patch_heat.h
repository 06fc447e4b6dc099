#pragma once

#include <Eigen/Core>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// What is given to each patch by itself, n each and NaN where its material tells; both empty where
/// nothing is.
struct PatchHeat {
  Eigen::VectorXd temperature;  ///< K
  Eigen::VectorXd heat_flux;    ///< B - H, W/m²

  [[nodiscard]] bool empty() const { return temperature.size() == 0; }
};

/// `Scene::given_heat` on the patches. Throws SceneError, with the file and the number: if there is
/// no such patch or polygon, or neither as many patches nor polygons as cells; if a patch is given
/// something twice, a temperature below 0, anything to a shield, or what a surface of emissivity 0
/// cannot give off; and if the bands hold no heat, or heat fluxes are given and they are not grey.
PatchHeat patch_heat(const Scene& scene, const PatchMesh& mesh);

}  // namespace radiosity
