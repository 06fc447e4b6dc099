#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "viewer/work/light_mix.h"

namespace viewer {

/// What patches get straight from those emitters of a mix that are no patches: luminaires, the sun
/// and the sky.
struct OuterLight {
  /// Per emitter at full strength, W/m², n x b; null for those that are surfaces.
  std::vector<std::shared_ptr<const Eigen::MatrixXd>> irradiance;
  LightMix of;  ///< whose sun and sky it has
};

/// That of a mix, with exact shadows. What the ground reflects counts to the sun or to the sky,
/// whichever it comes from. What `known` has of other sun and sky is not found anew. Throws
/// Interrupted.
std::shared_ptr<const OuterLight> outer_light(const radiosity::Scene& scene,
                                              const radiosity::PatchMesh& mesh, const LightMix& mix,
                                              std::shared_ptr<const OuterLight> known = {},
                                              const radiosity::Progress& progress = {});

/// The sum of them as the mix has them, W/m², n x b; empty if all emitters are surfaces.
Eigen::MatrixXd mixed_irradiance(const OuterLight& light, const LightMix& mix);

}  // namespace viewer
