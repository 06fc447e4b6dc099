#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/run/solved_scene.h"
#include "radiosity/stream/streamed_factors.h"

namespace apps {

/// What `form-factors` did.
struct FactorSummary {
  const PatchedScene& patched;
  const radiosity::StreamedFactors* factors = nullptr;  ///< none if the result was there already
  double min_factor = 0;                                ///< 0 = nothing dropped
  Eigen::MatrixXd by_surface{};  ///< factors between surfaces; empty if not asked for
  const std::vector<std::string>& outputs;
};

}  // namespace apps
