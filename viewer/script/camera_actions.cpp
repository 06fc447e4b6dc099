#include "viewer/script/camera_actions.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "viewer/desk/picking.h"

namespace viewer {
namespace {

constexpr double kDegree = radiosity::kPi / 180;

void check_open(const Stage& stage) {
  if (!stage.desk.session.is_open()) throw std::runtime_error("there is no scene");
}

void set_camera(Stage& stage, ScriptArguments& arguments) {
  check_open(stage);
  radiosity::Camera camera = stage.desk.camera.camera();
  if (arguments.has("position")) camera.position = arguments.vector("position");
  if (arguments.has("direction")) camera.direction = arguments.vector("direction");
  if (arguments.has("look_at")) camera.direction = arguments.vector("look_at") - camera.position;
  if (arguments.has("up")) camera.up = arguments.vector("up");
  camera.vertical_fov = kDegree * arguments.number_or("fov", camera.vertical_fov / kDegree);
  const bool is_possible = camera.direction.norm() > 0 && camera.up.norm() > 0 &&
                           camera.direction.cross(camera.up).norm() >
                               1e-6 * camera.direction.norm() * camera.up.norm() &&
                           camera.vertical_fov > 0 && camera.vertical_fov < radiosity::kPi;
  if (!is_possible) throw std::invalid_argument("nothing can be seen in that direction");
  stage.desk.camera = CameraControl(camera, stage.desk.session.model().bounds);
}

void set_up_axis(Stage& stage, ScriptArguments& arguments) {
  const auto axis = up_named(arguments.text("axis"));
  if (!axis) throw std::invalid_argument("'axis' must be y or z");
  set_up(stage.desk, *axis);
}

/// As a mouse at x, y would do it, if these are given.
void orbit(Stage& stage, ScriptArguments& arguments) {
  Desk& desk = stage.desk;
  const double right = kDegree * arguments.number_or("right", 0);
  const double up = kDegree * arguments.number_or("up", 0);
  radiosity::Vec3 center = desk.camera.pivot();
  if (arguments.has("x") || arguments.has("y")) {
    center = point_towards(desk, arguments.number("x"), arguments.number("y"));
  }
  if (arguments.has("about")) center = arguments.vector("about");
  desk.camera.orbit_about(center, right, up);
}

void zoom(Stage& stage, ScriptArguments& arguments) {
  Desk& desk = stage.desk;
  const double factor = arguments.number("factor");
  if (!(factor > 0)) throw std::invalid_argument("'factor' must be above 0");
  if (!arguments.has("x") && !arguments.has("y")) {
    desk.camera.zoom(factor);
    return;
  }
  desk.camera.zoom_to(point_towards(desk, arguments.number("x"), arguments.number("y")), factor);
}

void fly(Stage& stage, ScriptArguments& arguments) {
  stage.desk.camera.fly(arguments.number_or("forward", 0), arguments.number_or("right", 0),
                        arguments.number_or("up", 0));
}

void keep_view(Stage& stage, ScriptArguments& arguments) {
  check_open(stage);
  save_view(stage.desk.views, arguments.text("name"), stage.desk.camera.camera());
}

/// Both ends, or none.
void measure(Stage& stage, ScriptArguments& arguments) {
  Tape& tape = stage.desk.tape;
  tape = {};
  if (!arguments.has("from") && !arguments.has("to")) return;
  tape.from = arguments.vector("from");
  tape.to = arguments.vector("to");
}

void measure_at(Stage& stage, ScriptArguments& arguments) {
  const auto point = point_at(stage.desk, arguments.number("x"), arguments.number("y"));
  if (!point) throw std::invalid_argument("there is nothing to measure from");
  lay(stage.desk.tape, *point);
}

}  // namespace

std::map<std::string, ActionKind> camera_actions() {
  return {{"camera", {"", at_once(set_camera)}},
          {"set-up", {"axis", at_once(set_up_axis)}},
          {"orbit", {"", at_once(orbit)}},
          {"zoom", {"factor", at_once(zoom)}},
          {"fly", {"", at_once(fly)}},
          {"fit", {"", at_once([](Stage& stage, ScriptArguments&) { fit_camera(stage.desk); })}},
          {"scene-camera",
           {"", at_once([](Stage& stage, ScriptArguments&) { use_scene_camera(stage.desk); })}},
          {"save-view", {"name", at_once(keep_view)}},
          {"use-view", {"name", at_once([](Stage& stage, ScriptArguments& arguments) {
                          use_view(stage.desk, arguments.text("name"));
                        })}},
          {"forget-view", {"name", at_once([](Stage& stage, ScriptArguments& arguments) {
                             forget_view(stage.desk.views, arguments.text("name"));
                           })}},
          {"measure", {"", at_once(measure)}},
          {"measure-at", {"", at_once(measure_at)}}};
}

}  // namespace viewer
