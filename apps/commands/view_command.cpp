#include "apps/commands/view_command.h"

#include <CLI/App.hpp>
#include <filesystem>

#include "apps/terminal/output_files.h"
#include "apps/terminal/program_data.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "viewer/view.h"

namespace apps {
namespace {

constexpr int kLargestWindow = 16384;  // pixels
constexpr int kMostThreads = 4096;

}  // namespace

ViewCommand::ViewCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command =
      program.add_subcommand("view", "Look at a scene or a result in a desktop window");
  command
      ->add_option(
          "scene", path_,
          "Scene (.json, .obj, .ply, .stl, .off, .gltf, .glb, .msh, .vs3) or result (.vtp, .h5)")
      ->type_name("SCENE|RESULT");
  command->add_option("--unit", unit_, "Unit of the file's coordinates: m, mm, cm, in, ft, km, um")
      ->type_name("U");
  add_precision_option(*command, precision_);
  add_strict_option(*command, strict_);
  command->add_option("--script", script_, "Do the actions of this file, then close the window")
      ->type_name("FILE");
  command
      ->add_option("--screenshot", screenshot_,
                   "Write a picture of the window (.png) once the script is done or, without "
                   "one, the scene is solved; then close the window")
      ->check([](const std::string& path) { return check_extension(path, {".png"}); })
      ->type_name("FILE");
  command->add_option("--up", up_, "Axis that points upwards, y or z; default: guessed")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("AXIS");
  command->add_option("--width", width_, "Width of the window, pixels; default: 1280, by its scale")
      ->check(CLI::Range(64, kLargestWindow))
      ->type_name("W");
  command
      ->add_option("--height", height_, "Height of the window, pixels; default: 800, by its scale")
      ->check(CLI::Range(64, kLargestWindow))
      ->type_name("H");
  command
      ->add_option("--ui-scale", scale_,
                   "Size of text and panels; default: what the screen asks for")
      ->check(CLI::Range(0.5, 8.0))
      ->type_name("S");
  command->add_option("--threads", n_threads_, "Number of threads; 0 = all cores")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str()
      ->type_name("N");
  add_compute_options(*command, compute_);
  add_transport_option(*command, compute_);
  add_adaptive_option(*command, compute_);
  command->callback([this] { run(); });
}

void ViewCommand::run() const {
  if (path_ && !std::filesystem::is_regular_file(*path_)) {
    throw radiosity::SceneError(*path_ + ": there is no such file");
  }
  if (screenshot_) check_outputs({*screenshot_}, path_.value_or(""));
  const radiosity::ThreadLimit threads(n_threads_);
  viewer::ViewOptions options = {
      .path = path_,
      .solving = compute_,
      .reading = {.unit = unit_, .precision = precision_, .strict = strict_},
      .width = width_,
      .height = height_,
      .scale = scale_,
      .up = viewer::up_named(up_),
      .examples = program_data(RADIOSITY_SCENES, "scenes"),
      .stop = interruption_.token()};
  if (script_) options.script = *script_;
  if (screenshot_) options.screenshot = *screenshot_;
  viewer::view(options);
}

}  // namespace apps
