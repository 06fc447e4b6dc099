#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads a .vs3 file of View3D: grey, with emissivities as materials. Surfaces that are combined
/// become one; what lies in a base is cut out of it, null surfaces leave a hole; obstructions are
/// black, at no temperature, and come last. Coordinates in the file's unit. Scene::closed is what
/// encl says, if that is 1. Throws SceneError with file and line.
FileScene read_vs3(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
