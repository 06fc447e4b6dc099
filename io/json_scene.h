#pragma once

#include <filesystem>

#include "io/scene_file.h"
#include "radiosity/scene.h"

namespace io {

/// Reads a scene in our JSON format (docs/scene-format.md), in metres. Throws SceneError naming
/// the file and the line (syntax) or the item.
radiosity::Scene read_json_scene(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace io
