#pragma once

#include <string>
#include <vector>

#include "study/comfort.h"
#include "study/study.h"

namespace apps {

/// What `comfort` did.
struct ComfortSummary {
  const study::Study& study;
  std::vector<study::ComfortPoint> points;
  std::string posture;
  std::string body;  ///< how it takes up radiation
  const std::vector<std::string>& outputs;
};

std::string comfort_text(const ComfortSummary& summary);
std::string comfort_json(const ComfortSummary& summary, const std::vector<std::string>& warnings);

}  // namespace apps
