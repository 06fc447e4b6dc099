#include "viewer/script/grid_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "viewer/desk/grids.h"
#include "viewer/script/report_values.h"

namespace viewer {

using nlohmann::json;

namespace {

void choose_grid(Stage& stage, ScriptArguments& arguments) {
  const std::string name = arguments.text("grid");
  const auto grid = grid_named(stage.desk, name);
  if (!grid) throw std::invalid_argument(fmt::format("no grid is called '{}'", name));
  GridChoice choice = {.grid = *grid, .is_maintained = arguments.flag_or("maintained", true)};
  if (arguments.has("quantity")) {
    const std::string wanted = arguments.text("quantity");
    const std::vector<std::string> names = grid_quantities(stage.desk, *grid);
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) {
      throw std::invalid_argument(fmt::format("grid '{}' has no quantity '{}'; there are {}", name,
                                              wanted, fmt::join(names, ", ")));
    }
    choice.quantity = static_cast<std::size_t>(found - names.begin());
  }
  const bool has_numbers = arguments.flag_or("numbers", stage.desk.look.numbers);
  show_grid(stage.desk, choice);
  stage.desk.look.numbers = has_numbers;
}

json lines_json(const std::vector<GridLine>& lines) {
  json all = json::array();
  for (const GridLine& line : lines) {
    all.push_back({{"what", line.what},
                   {"value", line.value},
                   {"required", line.required},
                   {"met", line.is_met ? json(*line.is_met) : json(nullptr)}});
  }
  return all;
}

/// Numbers of a grid as they are, by quantity and age of the lamps.
json quantities_json(const study::MeasuredPlan& measured, const study::MeasuredPlanGrid& grid) {
  json all = json::array();
  for (const auto& quantity : grid.light.quantities) {
    json of = {{"name", quantity.name}};
    for (const study::LampAge age : {study::LampAge::new_lamps, study::LampAge::maintained}) {
      const auto found = radiosity::summary(grid.light.places, quantity.total(measured.light(age)));
      of[age == study::LampAge::new_lamps ? "new" : "maintained"] = {
          {"Em", number(found.mean)},
          {"Emin", number(found.least)},
          {"Emax", number(found.greatest)},
          {"U0", number(found.least_to_mean())},
          {"Ud", number(found.least_to_greatest())}};
    }
    all.push_back(std::move(of));
  }
  return all;
}

}  // namespace

std::map<std::string, ActionKind> grid_actions() {
  return {{"show-grid", {"grid", at_once(choose_grid)}}};
}

json grids_json(const Desk& desk) {
  if (!has_light_plan(desk.session)) return nullptr;
  json result = {{"note", grids_note(desk)},
                 {"required", requirement_text(desk)},
                 {"shown", nullptr},
                 {"grids", json::array()},
                 {"observers", lines_json(observer_lines(desk))}};
  const auto& grids = desk.session.model().scene->light_plan.grids;
  if (desk.look.show == Show::grid && desk.look.grid.grid < grids.size()) {
    result["shown"] = grids[desk.look.grid.grid].name;
  }
  const auto readings = desk.plan.readings();
  for (std::size_t g = 0; g < grids.size(); ++g) {
    json grid = {{"name", grids[g].name},
                 {"lines", lines_json(grid_lines(desk, {.grid = g, .is_maintained = true}))}};
    if (readings) {
      grid["quantities"] = quantities_json(readings->measured, readings->measured.grids[g]);
    }
    result["grids"].push_back(std::move(grid));
  }
  return result;
}

}  // namespace viewer
