#pragma once

#include <Eigen/Core>

#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// How the sun's light that patches reflect varies within them, for the edges of its shadows.
struct SunEdges {
  /// The standard deviation within each patch, of the mean over the bands, W/m², n_patches: of a
  /// patch that the sun lights a share s of, ρ E_n cosθ sqrt(s (1 - s)).
  Eigen::VectorXd deviation;
  /// The root mean square of its values over all of the scene, W/m².
  double typical = 0;
};

/// Shares are exact; panes count as open. Of a scene without a sun all is 0. Throws Interrupted.
SunEdges find_sun_edges(const Scene& scene, const PatchMesh& mesh, const Progress& progress = {});

}  // namespace radiosity
