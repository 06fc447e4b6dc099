#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "io/scene/read_options.h"
#include "study/study_options.h"
#include "viewer/desk/orientation.h"

namespace viewer {

struct ViewOptions {
  std::optional<std::string> path = {};  ///< scene or result to open; absent: an empty window
  study::StudyOptions solving = {};
  io::ReadOptions reading = {};
  /// Actions to do (docs/viewer.md); the window closes after them.
  std::optional<std::filesystem::path> script = {};
  /// Picture of the window, written when the script has ended or, without one, when the scene is
  /// solved; the window then closes. The window is as it is, with its panels.
  std::optional<std::filesystem::path> screenshot = {};
  int width = 0;                        ///< pixels; 0 = what suits the scale and the screen
  int height = 0;                       ///< pixels; likewise
  double scale = 0;                     ///< of text and panels; 0 = what the screen asks for
  std::optional<UpAxis> up = {};        ///< axis that points upwards; absent: guessed for each file
  std::filesystem::path examples = {};  ///< folder of scenes to offer
  std::stop_token stop = {};            ///< closes the window
};

/// Opens the desktop window and returns when it is closed. Throws WindowError if there is no
/// display or its OpenGL is too old, ScriptError, OutputError (a screenshot), Interrupted.
void view(const ViewOptions& options);

}  // namespace viewer
