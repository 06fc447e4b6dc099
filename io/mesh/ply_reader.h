#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads a .ply file, ascii or binary of either byte order: `vertex` elements with x, y, z of any
/// type and `face` elements with an integer list `vertex_indices` or `vertex_index`; all else is
/// skipped. One surface named after the file, without material (-1); coordinates in the file's
/// unit. Throws SceneError with file and line (ascii) or item and bytes (binary).
FileScene read_ply(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
