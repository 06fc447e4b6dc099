#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads an ascii Geomview .off file (also COFF, NOFF, STOFF and their combinations, whose extra
/// columns are ignored). One surface named after the file, without material (-1); coordinates in
/// the file's unit. Throws SceneError with file and line.
FileScene read_off(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
