#include "viewer/script/surface_actions.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "viewer/desk/desk_surfaces.h"
#include "viewer/desk/surface_groups.h"

namespace viewer {
namespace {

/// The group of a name, or whose index it is.
const SurfaceGroup& named(const std::vector<SurfaceGroup>& groups, const char* what,
                          const std::string& name) {
  std::string known;
  for (const SurfaceGroup& group : groups) {
    if (group.name == name || std::to_string(group.index) == name) return group;
    known += " '" + group.name + "'";
  }
  throw std::invalid_argument(fmt::format("no {} is called '{}'; there are{}", what, name,
                                          known.empty() ? " none" : known));
}

/// Those that are meant: a surface, or all of a material or lamp.
std::vector<std::int32_t> surfaces_of(const Stage& stage, ScriptArguments& arguments) {
  const Session& session = stage.desk.session;
  if (!session.is_open()) throw std::runtime_error("there is no scene");
  const bool is_material = arguments.has("material");
  if (is_material || arguments.has("emitter")) {
    if (!session.model().scene)
      throw std::runtime_error("a result has neither materials nor lamps");
    const char* what = is_material ? "material" : "emitter";
    const std::vector<SurfaceGroup> groups =
        is_material ? material_groups(*session.model().scene) : lamp_groups(session.mix());
    const std::string name = arguments.name(what);
    const SurfaceGroup& group = named(groups, what, name);
    if (group.surfaces.empty()) {
      throw std::invalid_argument(fmt::format("{} '{}' has no surfaces", what, group.name));
    }
    return group.surfaces;
  }
  const std::string name = arguments.name("surface");
  const auto surface = surface_named(*session.model().mesh, name);
  if (!surface) throw std::invalid_argument(fmt::format("no surface is called '{}'", name));
  return {*surface};
}

void show_surface(Stage& stage, ScriptArguments& arguments) {
  set_shown(stage.desk, surfaces_of(stage, arguments), arguments.flag_or("on", true));
}

void mark(Stage& stage, ScriptArguments& arguments) {
  const bool is_none = arguments.has("surface") && arguments.value("surface").is_null();
  mark_surfaces(stage.desk, is_none ? std::vector<std::int32_t>() : surfaces_of(stage, arguments));
}

void list_surfaces(Stage& stage, ScriptArguments& arguments) {
  const std::string by = arguments.has("by") ? arguments.text("by") : "surface";
  const std::map<std::string, SurfaceListing> listings = {{"surface", SurfaceListing::surfaces},
                                                          {"material", SurfaceListing::materials},
                                                          {"emitter", SurfaceListing::lamps}};
  const auto found = listings.find(by);
  if (found == listings.end()) {
    throw std::invalid_argument("'by' must be surface, material or emitter, found '" + by + "'");
  }
  stage.desk.listing = found->second;
  stage.desk.is_list_open = arguments.flag_or("open", true);
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
                                 isolate(stage.desk, surfaces_of(stage, arguments));
                               })}},
          {"show-all-surfaces",
           {"", at_once([](Stage& stage, ScriptArguments&) { stage.desk.look.hidden = {}; })}},
          {"mark-surface", {"surface", at_once(mark)}},
          {"list-surfaces", {"by", at_once(list_surfaces)}},
          {"sort-surfaces", {"by", at_once(sort_surfaces)}}};
}

}  // namespace viewer
