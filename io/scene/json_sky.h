#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// The sky of a scene, after its sun: how it is distributed (`type`, `perez`, `weather` or
/// `distribution`), how much of it there is, and the ground. Skies of measured weather bring their
/// sun. Throws SceneError naming the item.
void read_sky(const JsonItem& item, const std::filesystem::path& folder, radiosity::Scene& scene);

}  // namespace io
