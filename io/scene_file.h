#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "radiosity/progress.h"
#include "radiosity/scene.h"

namespace io {

struct ReadOptions {
  /// Unit of the file's coordinates ("m", "mm", "cm", "in", "ft", "km", "um"); overrides what a
  /// JSON scene says. Absent: the JSON scene's `unit`, else metre.
  std::optional<std::string> unit{};
  /// Scene::precision, m; overrides what a JSON scene says. Absent: the JSON scene's `precision`,
  /// else found from the digits of the coordinates.
  std::optional<double> precision{};
  /// Refuse what otherwise is read with a warning: bad polygons, materials that are not there,
  /// bytes after the end.
  bool strict = false;
  radiosity::Progress progress{};
};

/// Reads a scene by its extension: .obj (with its .mtl), .ply, .stl, .off, .gltf, .glb, or .json
/// (our own format, docs/scene-format.md). Polygons keep their order in the file; n-gons stay
/// n-gons (`meshing::make_patches` triangulates them). Bad ones are left out
/// (`meshing::leave_out_bad_polygons`); Scene::warnings tells. Throws SceneError with file, line or
/// item, what was found and what was expected.
radiosity::Scene read_scene(const std::filesystem::path& path, const ReadOptions& options = {});

/// Metres per unit. Throws SceneError for a unknown name, listing the known ones.
double metres_per_unit(const std::string& unit);

}  // namespace io
