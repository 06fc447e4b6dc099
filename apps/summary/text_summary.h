#pragma once

#include <string>
#include <vector>

#include "apps/run/factor_row.h"
#include "apps/run/factors_from.h"
#include "apps/summary/factor_summary.h"
#include "apps/summary/scenario_summary.h"
#include "apps/summary/solve_summary.h"

namespace apps {

/// What `solve` and `render` did, as an aligned table.
std::string solve_text(const SolveSummary& summary);

/// What `solve --scenarios` did: a line for each.
std::string scenarios_text(const ScenarioSummary& summary);

/// What `form-factors` did.
std::string form_factors_text(const FactorSummary& summary);

/// Where the power goes that leaves what `form-factors --from` names, one row per destination.
std::string factors_from_text(const FactorsFrom& factors, const std::vector<std::string>& outputs);

/// The row that `form-factors --row` names, by surface.
std::string factor_row_text(const FactorRow& row, const std::vector<std::string>& outputs);

}  // namespace apps
