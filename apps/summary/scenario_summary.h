#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/result/scenario_csv.h"
#include "radiosity/solve/solution.h"
#include "study/study.h"

namespace apps {

/// What `solve --scenarios` did.
struct ScenarioSummary {
  const study::Study& study;  ///< the form factors
  std::vector<io::ScenarioRow> scenarios;
  std::vector<radiosity::EnergyBalance> energies;  ///< of each
  std::vector<std::string> outputs;
  std::optional<std::string> operator_file;  ///< that has the form factors
};

}  // namespace apps
