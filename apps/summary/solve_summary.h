#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/run/solved_scene.h"
#include "apps/summary/quantity_summary.h"

namespace apps {

/// What `solve` or `render` did.
struct SolveSummary {
  const SolvedScene& solved;
  const std::vector<std::string>& outputs;
  std::vector<QuantitySummary> quantities = {};          ///< that were asked for
  std::optional<ShownScale> false_color = std::nullopt;  ///< of pictures in false colours
};

}  // namespace apps
