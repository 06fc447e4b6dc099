#include "viewer/script/daylight_actions.h"

#include <nlohmann/json.hpp>

#include "viewer/desk/daylight.h"
#include "viewer/script/report_values.h"

namespace viewer {

using nlohmann::json;

namespace {

constexpr double kDegrees = radiosity::kPi / 180;

void set_sun(Stage& stage, ScriptArguments& arguments) {
  stage.desk.session.begin_mix_step();
  if (arguments.has("latitude")) {
    radiosity::PlaceAndTime when;
    when.latitude = arguments.number("latitude") * kDegrees;
    when.longitude = arguments.number("longitude") * kDegrees;
    when.month = static_cast<int>(arguments.integer("month"));
    when.day = static_cast<int>(arguments.integer("day"));
    when.hour = arguments.number("hour");
    set_sun_time(stage.desk, when);
    return;
  }
  const SunPlace now = sun_place(stage.desk).value_or(SunPlace{});
  set_sun_place(stage.desk,
                {arguments.number_or("azimuth", now.azimuth / kDegrees) * kDegrees,
                 arguments.number_or("elevation", now.elevation / kDegrees) * kDegrees});
}

void set_sky(Stage& stage, ScriptArguments& arguments) {
  stage.desk.session.begin_mix_step();
  set_sky_type(stage.desk, static_cast<int>(arguments.integer("type")));
}

}  // namespace

std::map<std::string, ActionKind> daylight_actions() {
  return {{"set-sun", {"elevation", at_once(set_sun)}}, {"set-sky", {"type", at_once(set_sky)}}};
}

json daylight_json(const Desk& desk) {
  const auto place = sun_place(desk);
  if (!place) return nullptr;
  const auto type = sky_type(desk);
  const auto lux = sky_illuminance(desk);
  return {{"azimuth", number(place->azimuth / kDegrees)},
          {"elevation", number(place->elevation / kDegrees)},
          {"sky", type ? json(*type) : json(nullptr)},
          {"sky_illuminance", lux ? number(*lux) : json(nullptr)}};
}

}  // namespace viewer
