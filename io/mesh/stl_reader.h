#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads an ascii or binary .stl file. Equal vertex positions become one vertex, so that the
/// triangles are connected. Surfaces are the solids of an ascii file, or one named after the file;
/// they have no material (-1). Coordinates in the file's unit. The normals that the file gives are
/// not used: the order of the vertices says which side emits. Throws SceneError with file and
/// line, or bytes.
FileScene read_stl(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
