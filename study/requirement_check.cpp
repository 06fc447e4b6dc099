#include "study/requirement_check.h"

namespace study {
namespace {

using radiosity::GridSummary;
using radiosity::LightPart;

RequirementCheck at_least(const std::string& grid, const char* what, double asked, double found,
                          double error = 0) {
  return {grid, what, asked, found, error, found >= asked};
}

RequirementCheck ugr_at_most(const std::string& who, double limit, std::optional<double> found,
                             bool has_looked) {
  return {who, "UGR", limit, found, 0, has_looked && (!found || *found <= limit)};
}

}  // namespace

std::vector<RequirementCheck> requirement_checks(const MeasuredPlan& measured) {
  std::vector<RequirementCheck> checks;
  const radiosity::Index light = measured.light(LampAge::maintained);
  for (const MeasuredPlanGrid& grid : measured.grids) {
    const auto& required = grid.plan.required;
    const auto& quantity = grid.light.quantities.front();
    const GridSummary found = radiosity::summary(grid.light.places, quantity.total(light));
    const std::string& name = grid.plan.name;
    if (required.mean) {
      const double error =
          radiosity::summary(grid.light.places, quantity.part(light, LightPart::error)).mean;
      checks.push_back(at_least(name, "Em", *required.mean, found.mean, error));
    }
    if (required.uniformity) {
      checks.push_back(at_least(name, "U0", *required.uniformity, found.least_to_mean()));
    }
    if (required.diversity) {
      checks.push_back(at_least(name, "Ud", *required.diversity, found.least_to_greatest()));
    }
    if (required.glare) {
      checks.push_back(
          ugr_at_most(name, *required.glare, measured.largest_ugr(), !measured.observers.empty()));
    }
  }
  for (const MeasuredObserver& observer : measured.observers) {
    if (!observer.observer.limit) continue;
    checks.push_back(
        ugr_at_most(observer.observer.name, *observer.observer.limit, observer.glare.ugr(), true));
  }
  return checks;
}

}  // namespace study
