#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/stream/streamed_factors.h"

namespace apps {

/// What `form-factors` did.
struct FactorSummary {
  const radiosity::Scene& scene;
  const radiosity::PatchMesh& mesh;
  const radiosity::StreamedFactors* factors = nullptr;  ///< none if the result was there already
  double min_factor = 0;                                ///< 0 = nothing dropped
  Eigen::MatrixXd by_surface{};  ///< factors between surfaces; empty if not asked for
  const std::vector<std::string>& outputs;
};

}  // namespace apps
