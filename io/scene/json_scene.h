#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "io/scene/read_options.h"

namespace io {

/// Reads a scene in our JSON format (docs/scene-format.md), in metres. Throws SceneError naming
/// the file and the line (syntax) or the item.
FileScene read_json_scene(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace io
