#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/solve/quantity_summary.h"

namespace io {

/// What a scenario came to, by surface.
struct ScenarioRow {
  std::string name;
  std::vector<radiosity::QuantitySummary> quantities;  ///< the same ones in all
};

/// Writes one line for each surface of each scenario: scenario,surface,area, then of each quantity
/// and band its mean over the area, minimum and maximum (irradiance_0,irradiance_0_min,
/// irradiance_0_max), or of an additive one the sum (power_0); photometric ones have no number.
/// Throws OutputError.
void write_scenario_csv(const std::filesystem::path& path,
                        const std::vector<ScenarioRow>& scenarios);

}  // namespace io
