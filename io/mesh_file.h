#pragma once

#include <filesystem>
#include <string>

#include "radiosity/progress.h"
#include "radiosity/scene.h"

namespace io {

/// Extension of a path in lower case, with its dot: ".obj".
std::string lower_extension(const std::filesystem::path& path);

/// Reads a mesh by its extension: .obj, .off, .ply, .stl, .gltf or .glb. Coordinates are in the
/// file's unit, and so is Scene::precision, found from their digits; Surface::material is -1 where the file names no material; Scene::bands is RGB.
/// Throws SceneError, also if the file holds no polygons or more than can be numbered.
radiosity::Scene read_mesh(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
