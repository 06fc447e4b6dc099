#pragma once

#include <string>
#include <vector>

#include "apps/summary/light_summary.h"
#include "io/picture/grid_chart.h"

namespace apps {

/// All that a report on the lighting tells.
struct LightReport {
  const LightSummary& summary;
  const std::vector<std::string>& warnings;
  std::string version;
  std::string machine;
  std::string date;
};

/// A quantity of a grid as a picture shows it: of maintained lamps, if their light differs.
io::GridChart grid_chart(const study::MeasuredPlan& measured, const study::MeasuredPlanGrid& grid,
                         const radiosity::GridQuantity& quantity);

/// A page that needs no other file and can be printed: the room's surfaces, lamps, grids with
/// isolines, glare, what was required and whether it is met, the energy balance, and how right all
/// that is.
std::string light_report_html(const LightReport& report);

}  // namespace apps
