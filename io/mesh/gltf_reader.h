#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads a glTF 2.0 file (.gltf or .glb) in metres: the triangles of all nodes, transformed to the
/// scene, in the order of the node tree. A surface is a node and a material; `doubleSided` makes
/// it two-sided. Base colour with its texture is the reflectance, emissive colour the radiance,
/// three RGB bands; emissive textures are not read (a warning tells). Surface::material is -1 where
/// the file gives none. Throws SceneError naming the file.
FileScene read_gltf(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
