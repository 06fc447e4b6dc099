#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/stream/streamed_factors.h"

namespace apps {

/// What `form-factors` did.
struct FactorSummary {
  const radiosity::Scene& scene;
  const radiosity::PatchMesh& mesh;
  const radiosity::AssemblyReport* report = nullptr;  ///< none if the result was there already
  std::uint64_t bytes = 0;                            ///< of the work file, or of an operator
  double min_factor = 0;                              ///< 0 = nothing dropped
  radiosity::DroppedFactors dropped{};
  Eigen::MatrixXd by_surface{};  ///< factors between surfaces; empty if not asked for
  const std::vector<std::string>& outputs;
};

}  // namespace apps
