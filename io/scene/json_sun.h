#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// The sun of a scene: the irradiance normal to its beam, one value or one per band, and where it
/// stands, by the direction of its light or by azimuth and elevation. Warns of a sun below the
/// horizon. Throws SceneError naming the item.
void read_sun(const JsonItem& item, const std::filesystem::path& folder, radiosity::Scene& scene);

}  // namespace io
