#pragma once

#include <filesystem>

#include "io/scene/read_options.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Reads a scene by its extension: .obj (with its .mtl), .ply, .stl, .off, .gltf, .glb, .msh
/// (Gmsh), .vs3 (View3D), .vtk, .vtp, .vtu (programs that link radiosity::vtk) or .json (our own
/// format, docs/scene-format.md). Polygons keep their order in the file; n-gons stay n-gons
/// (`meshing::make_patches` triangulates them). Bad ones are left out
/// (`meshing::leave_out_bad_polygons`); Scene::warnings tells. Throws SceneError with file, line or
/// item, what was found and what was expected.
radiosity::Scene read_scene(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace io
