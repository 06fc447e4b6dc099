#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/false_color_options.h"
#include "radiosity/solve/quantity_summary.h"
#include "study/study.h"

namespace apps {

/// What `solve` or `render` did.
struct SolveSummary {
  const study::Study& solved;
  const std::vector<std::string>& outputs;
  std::optional<std::string> operator_file = std::nullopt;  ///< that has the form factors
  std::vector<radiosity::QuantitySummary> quantities = {};  ///< that were asked for
  std::optional<ShownScale> false_color = std::nullopt;     ///< of pictures in false colours
};

}  // namespace apps
