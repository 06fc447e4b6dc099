#pragma once

#include <string>
#include <vector>

#include "apps/run/factor_row.h"
#include "apps/run/factors_from.h"
#include "apps/summary/factor_summary.h"
#include "apps/summary/scenario_summary.h"
#include "apps/summary/solve_summary.h"
#include "meshing/inspect/inspect.h"
#include "radiosity/scene/scene.h"

namespace apps {

/// The JSON object that `solve` and `render` print (docs/command-line.md). What is not a finite
/// number is null.
std::string solve_json(const SolveSummary& summary, const std::vector<std::string>& warnings);

/// The JSON object that `solve --scenarios` prints.
std::string scenarios_json(const ScenarioSummary& summary,
                           const std::vector<std::string>& warnings);

/// The JSON object that `form-factors` prints.
std::string form_factors_json(const FactorSummary& summary,
                              const std::vector<std::string>& warnings);

/// The JSON object that `form-factors --from` prints.
std::string factors_from_json(const FactorsFrom& factors, const std::vector<std::string>& outputs,
                              const std::vector<std::string>& warnings);

/// The JSON object that `form-factors --row` prints.
std::string factor_row_json(const FactorRow& row, const std::vector<std::string>& outputs,
                            const std::vector<std::string>& warnings);

/// The JSON object that `inspect` prints.
std::string inspect_json(const radiosity::Scene& scene, const meshing::Inspection& inspection,
                         const std::vector<std::string>& outputs,
                         const std::vector<std::string>& warnings);

}  // namespace apps
