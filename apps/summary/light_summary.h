#pragma once

#include <string>
#include <vector>

#include "radiosity/picture/measured_grid.h"
#include "study/measured_plan.h"
#include "study/requirement_check.h"

namespace apps {

/// What `light` did.
struct LightSummary {
  const study::Study& solved;
  const study::MeasuredPlan& measured;
  std::vector<study::RequirementCheck> checks;
  const std::vector<std::string>& outputs;
  double efficacy;  ///< lm/W
};

/// A quantity of a grid and one of its lights.
struct LightRow {
  const study::MeasuredPlanGrid& grid;
  const radiosity::GridQuantity& quantity;
  study::LampAge age;
  radiosity::GridSummary total;
  double direct = 0;    ///< mean, lx
  double indirect = 0;  ///< mean, lx
  double error = 0;     ///< mean of one standard error, lx
};

/// All of them, grid by grid.
std::vector<LightRow> light_rows(const study::MeasuredPlan& measured);

/// "new", "maintained".
const char* age_name(study::LampAge age);

/// As aligned tables.
std::string light_text(const LightSummary& summary);

/// As one JSON object.
std::string light_json(const LightSummary& summary, const std::vector<std::string>& warnings);

}  // namespace apps
