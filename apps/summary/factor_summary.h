#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/made_part.h"
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
  std::optional<MadePart> part{};  ///< if no more than a part was made
  std::size_t n_merged = 0;        ///< parts that were put together, if so
  Eigen::MatrixXd by_surface{};    ///< factors between surfaces; empty if not asked for
  const std::vector<std::string>& outputs;
};

}  // namespace apps
