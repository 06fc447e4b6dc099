#include "apps/options/common_options.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cmath>

#include "apps/terminal/memory_size.h"
#include "apps/terminal/number_list.h"
#include "io/scene/scene_file.h"
#include "meshing/adaptive/adaptive.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"

namespace apps {
namespace {

constexpr int kLargestPicture = 16384;  // pixels a side
constexpr int kMostThreads = 4096;

std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  if (CLI::detail::lexical_cast(text, seed) && text.front() != '-') return "";
  return fmt::format("found '{}', expected a whole number from 0 on", text);
}

std::string check_unit(const std::string& text) {
  try {
    io::metres_per_unit(text);
    return "";
  } catch (const radiosity::SceneError& error) {
    return error.what();
  }
}

std::string check_samples(const std::string& text) {
  int samples = 0;
  if (CLI::detail::lexical_cast(text, samples) && samples > 0 && samples <= 4096) {
    const auto root = static_cast<int>(std::lround(std::sqrt(samples)));
    if (root * root == samples) return "";
  }
  return fmt::format("found '{}', expected a square number from 1 to 4096", text);
}

radiosity::Closed closed_choice(const std::string& choice) {
  if (choice == "auto") return radiosity::Closed::automatic;
  return choice == "yes" ? radiosity::Closed::yes : radiosity::Closed::no;
}

radiosity::TransportKind transport_named(const std::string& name) {
  if (name == "auto") return radiosity::TransportKind::automatic;
  return name == "dense" ? radiosity::TransportKind::dense : radiosity::TransportKind::compressed;
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  command
      .add_option(
          "SCENE", options.scene,
          "Scene file: .json (own format), .obj, .ply, .stl, .off, .gltf, .glb, .msh, .vs3, .vtk, "
          ".vtp, .vtu, .idf, .epJSON or .foam")
      ->required()
      ->type_name("");
  command
      .add_option("--unit", options.unit,
                  "Unit of the file's coordinates (m, mm, cm, in, ft ...); default: what a .json "
                  "scene says, else m")
      ->check(check_unit)
      ->type_name("U");
  add_precision_option(command, options.precision);
  add_strict_option(command, options.strict);
  add_run_options(command, options);
}

void add_run_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--threads", options.n_threads, "Threads to use; 0 = all cores")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str()
      ->type_name("N");
  command.add_flag("--json", options.json, "Print one JSON object on stdout instead of a table");
  command.add_flag("--quiet", options.quiet, "Show no progress on stderr");
}

void add_compute_options(CLI::App& command, study::StudyOptions& options) {
  const std::string patches = "Patches";
  auto* max_edge = command
                       .add_option("--max-edge", options.patches.max_edge,
                                   "Divide polygons until no patch edge is longer than L metres")
                       ->check(check_positive)
                       ->type_name("L")
                       ->group(patches);
  auto* n_patches =
      command
          .add_option("--patches", options.patches.n_patches,
                      fmt::format("Divide into about N patches of about equal size; "
                                  "without any of these three options {}, or {} more "
                                  "than polygons, of which small ones stay whole",
                                  meshing::kDefaultPatches, meshing::kDefaultBeyondPolygons))
          ->check(check_positive)
          ->type_name("N")
          ->group(patches);
  auto* as_is = command
                    .add_flag("--as-is", options.patches.as_is,
                              "Each polygon of the file is one patch, in file order")
                    ->group(patches);
  max_edge->excludes(n_patches)->excludes(as_is);
  n_patches->excludes(as_is);
  command.add_option("--tolerance", options.tolerance, "Relative error asked of the result")
      ->check(check_positive)
      ->capture_default_str()
      ->type_name("T");
  command
      .add_option_function<std::string>(
          "--closed",
          [&options](const std::string& choice) { options.closed = closed_choice(choice); },
          "Whether the surfaces enclose the space they light: yes, no or auto (what the "
          "scene says, else found out)")
      ->check(CLI::IsMember({"yes", "no", "auto"}))
      ->default_str("auto")
      ->type_name("C");
  add_seed_option(command, options.seed);
}

void add_precision_option(CLI::App& command, std::optional<double>& precision) {
  command
      .add_option("--precision", precision,
                  "How far coordinates may be off by rounding, metres: half a unit of their last "
                  "digit, 0 if they are exact; default: what a .json scene says, else found")
      ->check(CLI::NonNegativeNumber)
      ->type_name("L");
}

void add_strict_option(CLI::App& command, bool& strict) {
  command.add_flag("--strict", strict,
                   "Refuse what otherwise is read with a warning: polygons without an area, equal "
                   "or crossing themselves, missing materials, bytes after the end");
}

void add_seed_option(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "Seed of the visibility samples")
      ->check(check_seed)
      ->capture_default_str()
      ->type_name("S");
}

void add_transport_option(CLI::App& command, study::StudyOptions& options) {
  command
      .add_option_function<std::string>(
          "--transport",
          [&options](const std::string& name) { options.transport = transport_named(name); },
          fmt::format(
              "How form factors are kept: dense, all of them; compressed, for many patches: "
              "memory and time hardly grow faster than their number, and the error is "
              "verified; auto, compressed above {} patches or if dense ones do not fit",
              radiosity::kMostDense))
      ->check(CLI::IsMember({"auto", "dense", "compressed"}))
      ->default_str("auto")
      ->type_name("K");
}

void add_memory_option(CLI::App& command, study::StudyOptions& options) {
  command
      .add_option_function<std::string>(
          "--memory",
          [&options](const std::string& text) {
            options.memory = parse_memory_size(text).value_or(0);
          },
          "Memory that the form factors may take, such as 2GB or 500MiB; default: nine tenths of "
          "what there is")
      ->check(check_memory_size)
      ->type_name("SIZE");
}

void add_adaptive_option(CLI::App& command, study::StudyOptions& options) {
  command
      .add_flag("--adaptive", options.patches.adaptive,
                fmt::format("Make patches small where the light varies, until --tolerance is met "
                            "or --patches (default {}) are spent",
                            meshing::kMostAdaptivePatches))
      ->group("Patches")
      ->excludes(command.get_option("--max-edge"))
      ->excludes(command.get_option("--as-is"));
}

void add_operator_option(CLI::App& command, std::optional<std::string>& file) {
  command
      .add_option("--operator", file,
                  "Take patches and form factors of the same surfaces from this file (.h5), which "
                  "'solve -o' or 'form-factors -o' wrote; light, reflectances and bands may differ")
      ->type_name("FILE")
      ->excludes(command.get_option("--transport"))
      ->excludes(command.get_option("--adaptive"));
}

void add_assembly_options(CLI::App& command, study::StudyOptions& options,
                          std::optional<std::string>& file) {
  add_compute_options(command, options);
  add_transport_option(command, options);
  add_memory_option(command, options);
  add_adaptive_option(command, options);
  add_operator_option(command, file);
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_camera_options(command, options.camera);
  auto* false_color = add_false_color_options(command, options.false_color);
  add_photometry_options(command, options.photometry);
  const std::string picture = "Picture";
  command.add_option("--width", options.render.width, "Width of the picture, pixels")
      ->check(CLI::Range(1, kLargestPicture))
      ->capture_default_str()
      ->type_name("W")
      ->group(picture);
  command.add_option("--height", options.render.height, "Height of the picture, pixels")
      ->check(CLI::Range(1, kLargestPicture))
      ->capture_default_str()
      ->type_name("H")
      ->group(picture);
  command.add_option("--samples", options.render.samples, "Rays per pixel, a square number")
      ->check(check_samples)
      ->capture_default_str()
      ->type_name("N")
      ->group(picture);
  command
      .add_flag("--gather", options.gather,
                "Gather the light of each pixel anew from the patches: crisp shadows")
      ->excludes(false_color)
      ->group(picture);
  command
      .add_option("--exposure", options.image.exposure,
                  "Factor from radiance to brightness in a .png; default: chosen to fit")
      ->check(check_positive)
      ->excludes(false_color)
      ->type_name("X")
      ->group(picture);
}

}  // namespace apps
