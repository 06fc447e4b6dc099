#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/options/camera_options.h"
#include "apps/options/false_color_options.h"
#include "apps/options/heat_options.h"
#include "apps/options/quantity_options.h"
#include "io/picture/image_file.h"
#include "radiosity/picture/render.h"
#include "study/study_options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// Options that every subcommand takes.
struct CommonOptions {
  std::string scene;                ///< file name
  std::optional<std::string> unit;  ///< of the file's coordinates; absent: what the file says
  std::optional<double> precision;  ///< of the coordinates, m; absent: as the file says, else found
  bool strict = false;              ///< refuse files with faults that can be mended
  std::size_t n_threads = 0;        ///< 0 = all cores
  bool json = false;                ///< one JSON object on stdout instead of the table
  bool quiet = false;               ///< no progress on stderr
  HeatOptions heat;                 ///< of single patches
  /// Files that the run writes: none of them may be one that the scene is read from.
  std::vector<std::string> outputs;
};

/// How pictures are made.
struct PictureOptions {
  bool gather = false;  ///< gather the light of each pixel anew instead of interpolating
  radiosity::RenderOptions render;
  io::ImageOptions image;
  CameraOptions camera;
  FalseColorOptions false_color;
  PhotometryOptions photometry;
};

/// These bind the options to the command; `options` must outlive the parsing.
void add_common_options(CLI::App& command, CommonOptions& options);
/// Those of the common options that have to do with running, not with a scene.
void add_run_options(CLI::App& command, CommonOptions& options);
void add_strict_option(CLI::App& command, bool& strict);
void add_precision_option(CLI::App& command, std::optional<double>& precision);
void add_seed_option(CLI::App& command, std::uint64_t& seed);
/// Those of a computation, but for how it goes on once there are patches.
void add_compute_options(CLI::App& command, study::StudyOptions& options);
/// --transport.
void add_transport_option(CLI::App& command, study::StudyOptions& options);
/// --memory, for an operator in memory.
void add_memory_option(CLI::App& command, study::StudyOptions& options);
/// --adaptive, after add_compute_options and add_transport_option.
void add_adaptive_option(CLI::App& command, study::StudyOptions& options);
/// --operator, after those.
void add_operator_option(CLI::App& command, std::optional<std::string>& file);
/// All of these: what commands take that go on with patches and form factors in memory.
void add_assembly_options(CLI::App& command, study::StudyOptions& options,
                          std::optional<std::string>& file);
void add_picture_options(CLI::App& command, PictureOptions& options);

}  // namespace apps
