#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/daylight.h"

namespace apps {

/// What `daylight` did.
struct DaylightSummary {
  const study::Study& study;
  std::span<const study::DaylightPoint> points;
  std::span<const radiosity::PointPlace> places;
  std::span<const study::DaylightFactor> factors;
  double horizontal = 0;       ///< E_h, by `weights` of the bands
  bool is_photometric = true;  ///< whether that is in lx
  const std::vector<std::string>& outputs;
};

std::string daylight_text(const DaylightSummary& summary);

/// As one JSON object.
std::string daylight_json(const DaylightSummary& summary, const std::vector<std::string>& warnings);

}  // namespace apps
