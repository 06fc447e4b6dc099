#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads a Wavefront .obj with the .mtl files that it names. Polygons in the order of their `f`
/// lines; coordinates in the file's unit. Surfaces come from `o`, before the first `o` from `g`,
/// and from `usemtl`; Surface::material is -1 where no `usemtl` was given or what it names is not
/// there. Three RGB bands. Throws SceneError with file and line.
FileScene read_obj(const std::filesystem::path& path, MeshMaterials materials,
                   const radiosity::Progress& progress);

}  // namespace io
