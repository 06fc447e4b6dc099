#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/solve/solution.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/model.h"

namespace viewer {

/// Where the light of one patch comes from: B_patch = Σ_j importance_j M_j for any exitance M.
struct LightPath {
  radiosity::Index patch = -1;
  Eigen::MatrixXd importance;  ///< n x b, dimensionless
};

/// What one emitter contributes to a patch.
struct EmitterShare {
  std::size_t emitter = 0;    ///< index into the mix
  Eigen::VectorXd radiosity;  ///< of the patch, W/m², per band
  double share = 0;           ///< of the patch's radiosity, all bands together, in [0, 1]
};

/// What each emitter of a mix contributes to the patch of the model, the largest first: what it
/// emits or, of those that are no surfaces, what patches reflect straight of it. `solution` is the
/// mix's.
std::vector<EmitterShare> emitter_shares(const LightPath& path, const Model& model,
                                         const radiosity::Solution& solution, const LightMix& mix);

}  // namespace viewer
