#include "apps/options/camera_options.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <string>

#include "apps/terminal/number_list.h"
#include "radiosity/picture/render.h"

namespace apps {
namespace {

using radiosity::Camera;
using radiosity::Vec3;

/// Sine of the angle between `up` and the view below which they count as parallel.
constexpr double kParallel = 1e-6;

std::optional<Vec3> as_point(const std::string& text) {
  const auto numbers = as_numbers(text, 3);
  return numbers ? std::optional(Vec3(numbers->data())) : std::nullopt;
}

std::string check_point(const std::string& text) {
  if (as_point(text)) return "";
  return fmt::format("found '{}', expected three numbers x,y,z", text);
}

std::string check_direction(const std::string& text) {
  const auto direction = as_point(text);
  if (direction && direction->stableNorm() > 0) return "";
  return fmt::format("found '{}', expected three numbers x,y,z, not all 0", text);
}

std::string check_angle(const std::string& text) {
  const auto degrees = as_number(text);
  if (degrees && *degrees > 0 && *degrees < 180) return "";
  return fmt::format("found '{}', expected an angle between 0 and 180 degrees", text);
}

CLI::Option* add_vector(CLI::App& command, const std::string& name, std::optional<Vec3>& target,
                        const std::string& description, std::string (*check)(const std::string&)) {
  return command
      .add_option_function<std::string>(
          name, [&target](const std::string& text) { target = as_point(text); }, description)
      ->check(check)
      ->type_name("x,y,z")
      ->group("Camera");
}

bool is_parallel(const Vec3& up, const Vec3& direction) {
  return !(up.normalized().cross(direction.normalized()).norm() > kParallel);
}

/// Looks from the camera's position to a point.
void aim(Camera& camera, const Vec3& point) {
  const Vec3 view = point - camera.position;
  const double length = view.stableNorm();
  if (!(length > 0)) throw CLI::ValidationError("--look-at", "is the camera's position");
  camera.direction = view / length;
}

/// Keeps `up` unless it is parallel to the view and nobody asked for it.
void settle_up(Camera& camera, const CameraOptions& options) {
  if (options.up) camera.up = options.up->stableNormalized();
  if (!is_parallel(camera.up, camera.direction)) return;
  if (options.up) throw CLI::ValidationError("--up", "is parallel to the viewing direction");
  camera.up = is_parallel(Vec3::UnitY(), camera.direction) ? Vec3::UnitZ() : Vec3::UnitY();
}

Camera view_named(const radiosity::Scene& scene, const std::string& name) {
  std::string names;
  for (const radiosity::View& view : scene.views) {
    if (view.name == name) return view.camera;
    names += fmt::format("{} '{}'", names.empty() ? "" : ",", view.name);
  }
  throw CLI::ValidationError(
      "--view", names.empty() ? fmt::format("the scene has no views, so none called '{}'", name)
                              : fmt::format("no view is called '{}'; there are{}", name, names));
}

}  // namespace

void add_camera_options(CLI::App& command, CameraOptions& options) {
  const std::string what = "; default: the scene's";
  command.add_option("--view", options.view, "One of the scene's views, by its name")
      ->type_name("NAME")
      ->group("Camera");
  add_vector(command, "--camera-position", options.position, "Where the camera stands, m" + what,
             check_point);
  auto* look_at = add_vector(command, "--look-at", options.look_at,
                             "Point in the middle of the picture, m", check_point);
  auto* direction = add_vector(command, "--camera-direction", options.direction,
                               "Viewing direction" + what, check_direction);
  look_at->excludes(direction);
  add_vector(command, "--up", options.up, "Direction that is up in the picture" + what,
             check_direction);
  command.add_option("--fov", options.fov, "Full vertical angle of view, degrees" + what)
      ->check(check_angle)
      ->type_name("DEG")
      ->group("Camera");
}

ChosenCamera choose_camera(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                           const CameraOptions& options) {
  const std::optional<Camera> given =
      options.view ? view_named(scene, *options.view) : scene.camera;
  const bool has_position = options.position || given;
  Camera camera = given.value_or(radiosity::fit_camera(mesh));
  if (options.fov) camera.vertical_fov = *options.fov * radiosity::kPi / 180;
  if (options.position) camera.position = *options.position;
  if (options.direction) {
    camera.direction = options.direction->stableNormalized();
  } else if (options.look_at) {
    aim(camera, *options.look_at);
  } else if (options.position && !given) {
    const Vec3 center = radiosity::bounds(mesh).center();
    if (camera.position != center) aim(camera, center);
  }
  settle_up(camera, options);
  if (!has_position) camera = radiosity::fit_camera(mesh, camera);
  return {camera, has_position};
}

}  // namespace apps
