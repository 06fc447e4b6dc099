#include "viewer/desk/grids.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "io/picture/grid_chart.h"
#include "viewer/desk/desk.h"
#include "viewer/work/daylight_factor.h"

namespace viewer {
namespace {

using radiosity::GridPlan;
using study::LampAge;
using study::MeasuredPlanGrid;
using study::RequirementCheck;

const radiosity::LightPlan& plan_of(const Desk& desk) {
  static const radiosity::LightPlan kNone;
  return desk.session.model().scene ? desk.session.model().scene->light_plan : kNone;
}

radiosity::Index light_of(const PlanReadings& readings, const GridChoice& choice) {
  return readings.measured.light(choice.is_maintained ? LampAge::maintained : LampAge::new_lamps);
}

/// A requirement of a grid, or of an observer.
const RequirementCheck* check_of(const PlanReadings& readings, const std::string& of,
                                 const std::string& what) {
  for (const RequirementCheck& check : readings.checks) {
    if (check.grid == of && check.what == what) return &check;
  }
  return nullptr;
}

void add_line(std::vector<GridLine>& lines, const std::string& what, const std::string& value,
              const RequirementCheck* check) {
  GridLine line = {.what = what, .value = value};
  if (check != nullptr) {
    line.required = fmt::format("{} {:g}", what == "UGR" ? "≤" : "≥", check->asked);
    line.is_met = check->is_met;
  }
  lines.push_back(std::move(line));
}

std::string ugr_text(const std::optional<double>& ugr) {
  return ugr ? fmt::format("{:.1f}", *ugr) : "-";
}

}  // namespace

void show_grid(Desk& desk, const GridChoice& choice) {
  const radiosity::LightPlan& plan = plan_of(desk);
  if (choice.grid >= plan.grids.size()) {
    throw std::out_of_range(
        fmt::format("there is no grid {}; the scene has {}", choice.grid, plan.grids.size()));
  }
  const std::size_t n = grid_quantities(desk, choice.grid).size();
  if (choice.quantity >= n) {
    throw std::out_of_range(fmt::format("grid \"{}\" has no quantity {}; it has {}",
                                        plan.grids[choice.grid].name, choice.quantity, n));
  }
  desk.plan.set_wanted(true);
  const bool is_other = desk.look.show != Show::grid;
  if (is_other) show(desk, "grid");
  if (is_other || desk.look.grid != choice) desk.look.range.reset();
  desk.look.grid = choice;
  if (is_other) desk.look.isolines = true;
}

std::optional<std::size_t> grid_named(const Desk& desk, const std::string& name) {
  const auto& grids = plan_of(desk).grids;
  const auto found = std::find_if(grids.begin(), grids.end(),
                                  [&](const GridPlan& grid) { return grid.name == name; });
  if (found == grids.end()) return std::nullopt;
  return static_cast<std::size_t>(found - grids.begin());
}

std::vector<std::string> grid_quantities(const Desk& desk, std::size_t grid) {
  std::vector<std::string> names;
  if (const auto readings = desk.plan.readings()) {
    for (const auto& quantity : readings->measured.grids.at(grid).light.quantities) {
      names.push_back(quantity.name);
    }
    return names;
  }
  // As measure_grid will have them.
  const GridPlan& plan = plan_of(desk).grids.at(grid);
  names.emplace_back("illuminance");
  if (plan.is_cylindrical) names.emplace_back("cylindrical");
  names.resize(names.size() + plan.vertical.size(), "vertical");
  names.resize(names.size() + plan.semi_cylindrical.size(), "semi-cylindrical");
  names.resize(names.size() + plan.luminance_from.size(), "luminance");
  if (has_daylight_factors(*desk.session.model().scene)) names.emplace_back(kDaylightFactor);
  return names;
}

std::vector<GridLine> grid_lines(const Desk& desk, const GridChoice& choice) {
  std::vector<GridLine> lines;
  const auto readings = desk.plan.readings();
  if (!readings || choice.grid >= readings->measured.grids.size()) return lines;
  const MeasuredPlanGrid& grid = readings->measured.grids[choice.grid];
  const auto& quantity = grid.light.quantities.at(choice.quantity);
  const radiosity::Index light = light_of(*readings, choice);
  const radiosity::GridSummary found = radiosity::summary(grid.light.places, quantity.total(light));
  const bool is_required_of =
      choice.quantity == 0 && light == readings->measured.light(LampAge::maintained);
  const auto check = [&](const char* what) {
    return is_required_of ? check_of(*readings, grid.plan.name, what) : nullptr;
  };
  const auto lux = [&](double value) { return io::value_text(value) + " " + quantity.unit; };
  const double error =
      radiosity::summary(grid.light.places, quantity.part(light, radiosity::LightPart::error)).mean;
  const bool is_share = quantity.name == kDaylightFactor;
  add_line(lines, is_share ? "mean" : "Em", fmt::format("{} ± {:.1g}", lux(found.mean), error),
           check("Em"));
  add_line(lines, is_share ? "least" : "Emin", lux(found.least), nullptr);
  add_line(lines, is_share ? "greatest" : "Emax", lux(found.greatest), nullptr);
  add_line(lines, "U0", fmt::format("{:.3f}", found.least_to_mean()), check("U0"));
  add_line(lines, "Ud", fmt::format("{:.3f}", found.least_to_greatest()), check("Ud"));
  if (const RequirementCheck* glare = check("UGR")) {
    add_line(lines, "UGR", ugr_text(glare->found), glare);
  }
  std::string points = std::to_string(found.n);
  if (found.n_inside > 0) points += fmt::format(", {} in solids", found.n_inside);
  if (found.n_outside > 0) points += fmt::format(", {} outside", found.n_outside);
  add_line(lines, "points", points, nullptr);
  return lines;
}

std::vector<GridLine> observer_lines(const Desk& desk) {
  std::vector<GridLine> lines;
  const auto readings = desk.plan.readings();
  if (!readings) return lines;
  for (const study::MeasuredObserver& seen : readings->measured.observers) {
    const std::string& name = seen.observer.name;
    add_line(lines, "UGR", ugr_text(seen.glare.ugr()), check_of(*readings, name, "UGR"));
    lines.back().what = name;
  }
  return lines;
}

std::string requirement_text(const Desk& desk) {
  const auto readings = desk.plan.readings();
  if (!readings || readings->checks.empty()) return "";
  const auto n_met = std::count_if(readings->checks.begin(), readings->checks.end(),
                                   [](const RequirementCheck& check) { return check.is_met; });
  return fmt::format("{} of {} required values met", n_met, readings->checks.size());
}

bool are_requirements_met(const Desk& desk) {
  const auto readings = desk.plan.readings();
  return readings && std::all_of(readings->checks.begin(), readings->checks.end(),
                                 [](const RequirementCheck& check) { return check.is_met; });
}

std::optional<ShownGrid> shown_grid(const Desk& desk) {
  const auto readings = desk.plan.readings();
  const GridChoice& choice = desk.look.grid;
  if (desk.look.show != Show::grid || !readings) return std::nullopt;
  if (choice.grid >= readings->measured.grids.size()) return std::nullopt;
  const MeasuredPlanGrid& grid = readings->measured.grids[choice.grid];
  const auto& quantity = grid.light.quantities.at(choice.quantity);
  ShownGrid shown;
  if (grid.light.where.grid) shown.measured.grid = *grid.light.where.grid;
  shown.measured.places = grid.light.places;
  shown.points = grid.light.where.points;
  shown.values = quantity.total(light_of(*readings, choice));
  shown.unit = quantity.unit == "lx" ? "lux" : quantity.unit;
  shown.title = grid.plan.name + ": " + quantity.name;
  if (readings->measured.has_maintenance && quantity.name != kDaylightFactor) {
    shown.title += choice.is_maintained ? ", maintained" : ", new lamps";
  }
  return shown;
}

std::string grids_note(const Desk& desk) {
  if (!desk.plan.is_wanted()) return "not measured";
  if (desk.plan.is_current(desk.session)) return "";
  const WorkStatus status = desk.plan.status();
  if (status.is_busy && status.total > 0) {
    return fmt::format("being measured, {:.0f} %", 100 * status.done / status.total);
  }
  if (desk.plan.is_busy()) return "being measured";
  const bool is_coming = !desk.session.is_settled() || desk.session.is_previewing();
  return is_coming ? "waits for the light and its errors"
                   : "not measured: there is no solved light";
}

}  // namespace viewer
