#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/measured_plan.h"

namespace study {

/// Something that is asked of the light, and what was found.
struct RequirementCheck {
  std::string grid;             ///< or the observer
  std::string what;             ///< "Em", "U0", "Ud" or "UGR"
  double asked = 0;             ///< lux, or a plain number
  std::optional<double> found;  ///< of maintained lamps, UGR of new ones; empty: nothing dazzles
  double error = 0;             ///< one standard error of Em, lux; 0: not told
  bool is_met = false;
};

/// What the grids require of their first quantity and observers of UGR, in their order. The UGR
/// that a grid requires holds for all observers; without any it is not met, for nobody looked.
std::vector<RequirementCheck> requirement_checks(const MeasuredPlan& measured);

}  // namespace study
