#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads a mesh by its extension: .obj, .off, .ply, .stl, .gltf, .glb, .msh, .vs3, .vtk, .vtp or
/// .vtu. Coordinates are in the file's unit, and so is Scene::precision, found from their digits;
/// Surface::material is -1 where the file names no material; Scene::bands is RGB. Polygons may have
/// fewer than three corners, or be bad otherwise. Throws SceneError, also if the file holds no
/// polygons or more than can be numbered.
FileScene read_mesh(const std::filesystem::path& path, MeshMaterials materials,
                    const radiosity::Progress& progress);

}  // namespace io
