#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Adds the `luminaires` of a JSON scene, whose bands are known already, with their photometric
/// files, which are looked for relative to `folder`. Positions become metres; `unit` is the metres
/// per unit of the scene. Throws SceneError naming the item, or the file and its line.
void read_luminaires(const JsonItem& luminaires, const std::filesystem::path& folder, double unit,
                     const radiosity::Progress& progress, radiosity::Scene& scene);

/// The same as they are written: each by itself, with files relative to `folder` and numbers that
/// bring back the same light.
Json luminaires_json(const radiosity::Scene& scene, const std::filesystem::path& folder);

}  // namespace io
