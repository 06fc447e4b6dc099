#include "viewer/script/meter_actions.h"

#include <fmt/format.h>

#include <stdexcept>

#include "radiosity/base/error.h"
#include "viewer/desk/measuring.h"

namespace viewer {
namespace {

double length(ScriptArguments& arguments, const std::string& key, double otherwise, double least) {
  const double value = arguments.number_or(key, otherwise);
  if (value >= least) return value;
  throw std::invalid_argument(fmt::format("'{}' must be at least {} m", key, least));
}

void work_plane(Stage& stage, ScriptArguments& arguments) {
  Desk& desk = stage.desk;
  radiosity::WorkPlaneOptions options = desk.meter.plane().value_or(radiosity::WorkPlaneOptions{});
  options.height = arguments.number_or("height", options.height);
  options.border = length(arguments, "border", options.border, 0);
  options.spacing = length(arguments, "spacing", options.spacing, 0);
  const bool is_on = arguments.flag_or("on", true);
  const bool has_isolines = arguments.flag_or("isolines", true);
  const bool has_numbers = arguments.flag_or("numbers", desk.look.numbers);
  if (!is_on) {
    hide_work_plane(desk);
    return;
  }
  show_work_plane(desk, options);
  if (arguments.has("isolines")) desk.look.isolines = has_isolines;
  desk.look.numbers = has_numbers;
}

void add_point(Stage& stage, ScriptArguments& arguments) {
  if (!arguments.has("position")) {
    if (!add_meter_at(stage.desk, arguments.number("x"), arguments.number("y"))) {
      throw std::invalid_argument("there is nothing to measure at");
    }
    return;
  }
  const radiosity::Vec3 up = up_direction(stage.desk.up);
  add_meter(stage.desk, arguments.vector("position"),
            arguments.has("normal") ? arguments.vector("normal") : up);
}

/// Of the list, counted from 1 as it is there.
void remove_point(Stage& stage, ScriptArguments& arguments) {
  const long point = arguments.integer("point");
  if (point < 1) throw std::invalid_argument("'point' must be at least 1");
  stage.desk.meter.remove(static_cast<std::size_t>(point - 1));
}

/// Waits until all is measured.
bool save_meters(Stage& stage, ScriptArguments& arguments) {
  const std::string file = arguments.text("file");
  if (stage.is_first || stage.desk.meter.is_busy()) return false;
  save_readings(stage.desk, file);
  return true;
}

}  // namespace

std::map<std::string, ActionKind> meter_actions() {
  return {{"work-plane", {"height", at_once(work_plane)}},
          {"add-meter", {"", at_once(add_point)}},
          {"remove-meter", {"point", at_once(remove_point)}},
          {"save-readings", {"file", save_meters}}};
}

}  // namespace viewer
