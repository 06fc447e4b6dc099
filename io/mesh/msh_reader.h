#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads a mesh of Gmsh (.msh, text or binary, versions 2 and 4.1): its triangles and quads, of
/// those of higher order the corners. Physical groups become surfaces, of which a polygon has the
/// first; polygons in none are named after their geometric entity. Other cells are left out.
/// Materials are -1. Throws SceneError with file and line, of binary numbers the byte.
FileScene read_msh(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
