#pragma once

#include <filesystem>
#include <string>

#include "io/file_scene.h"
#include "radiosity/progress.h"

namespace io {

/// Extension of a path in lower case, with its dot: ".obj".
std::string lower_extension(const std::filesystem::path& path);

/// Reads a mesh by its extension: .obj, .off, .ply, .stl, .gltf or .glb. Coordinates are in the
/// file's unit, and so is Scene::precision, found from their digits; Surface::material is -1 where
/// the file names no material; Scene::bands is RGB. Polygons may have fewer than three corners, or
/// be bad otherwise. Throws SceneError, also if the file holds no polygons or more than can be
/// numbered.
FileScene read_mesh(const std::filesystem::path& path, MeshMaterials materials,
                    const radiosity::Progress& progress);

}  // namespace io
