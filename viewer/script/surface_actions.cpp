#include "viewer/script/surface_actions.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "viewer/desk/desk_surfaces.h"

namespace viewer {
namespace {

std::int32_t surface_of(const Stage& stage, ScriptArguments& arguments) {
  if (!stage.desk.session.is_open()) throw std::runtime_error("there is no scene");
  const std::string name = arguments.name("surface");
  const auto surface = surface_named(*stage.desk.session.model().mesh, name);
  if (!surface) throw std::invalid_argument(fmt::format("no surface is called '{}'", name));
  return *surface;
}

void show_surface(Stage& stage, ScriptArguments& arguments) {
  set_shown(stage.desk, surface_of(stage, arguments), arguments.flag_or("on", true));
}

void mark(Stage& stage, ScriptArguments& arguments) {
  if (arguments.value("surface").is_null()) {
    mark_surface(stage.desk, std::nullopt);
  } else {
    mark_surface(stage.desk, surface_of(stage, arguments));
  }
}

void sort_surfaces(Stage& stage, ScriptArguments& arguments) {
  const std::string name = arguments.text("by");
  const auto column = total_column_named(name);
  if (!column) {
    throw std::invalid_argument(
        "'by' must be name, area, flux, irradiance, heat or temperature, found '" + name + "'");
  }
  stage.desk.surface_order = {.column = *column, .is_falling = arguments.flag_or("falling", false)};
}

}  // namespace

std::map<std::string, ActionKind> surface_actions() {
  return {{"show-surface", {"surface", at_once(show_surface)}},
          {"isolate-surface", {"surface", at_once([](Stage& stage, ScriptArguments& arguments) {
                                 isolate(stage.desk, surface_of(stage, arguments));
                               })}},
          {"show-all-surfaces",
           {"", at_once([](Stage& stage, ScriptArguments&) { stage.desk.look.hidden = {}; })}},
          {"mark-surface", {"surface", at_once(mark)}},
          {"sort-surfaces", {"by", at_once(sort_surfaces)}}};
}

}  // namespace viewer
