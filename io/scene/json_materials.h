#pragma once

#include <filesystem>
#include <vector>

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Reads the `materials` of a JSON scene: an object keyed by name, or a list of objects with a
/// `name`. CSV files are looked for relative to `folder`. Throws SceneError naming the item.
std::vector<radiosity::Material> read_materials(const JsonItem& materials,
                                                const radiosity::Bands& bands,
                                                const std::filesystem::path& folder);

}  // namespace io
