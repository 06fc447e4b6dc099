#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Metres per unit of the unit that the item names. Throws SceneError naming the item.
double read_unit(const JsonItem& item);

/// Appends the `surfaces` of a JSON scene to the file's scene, whose bands and materials are known
/// already. Meshes are looked for relative to `folder`. Coordinates become metres; `unit` is the
/// metres per unit of the scene. Finds the scene's precision. Throws SceneError naming the item.
void add_surfaces(const JsonItem& surfaces, const std::filesystem::path& folder, double unit,
                  const radiosity::Progress& progress, FileScene& file);

}  // namespace io
