#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/run/daylight_hours.h"
#include "study/daylight_year.h"

namespace apps {

/// What `daylight-year` did.
struct DaylightYearSummary {
  const study::Study& study;
  std::span<const study::DaylightPoint> points;
  std::vector<PointYear> years;  ///< per point
  radiosity::Index n_hours = 0;  ///< that count
  radiosity::Index n_light = 0;  ///< of them with light
  radiosity::Index n_parts = 0;  ///< of the sky
  double threshold = 300;        ///< of the autonomy
  bool is_photometric = true;
  const std::vector<std::string>& outputs;
};

std::string daylight_year_text(const DaylightYearSummary& summary);

/// As one JSON object.
std::string daylight_year_json(const DaylightYearSummary& summary,
                               const std::vector<std::string>& warnings);

}  // namespace apps
