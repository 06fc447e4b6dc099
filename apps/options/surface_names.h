#pragma once

#include <string>

#include "radiosity/scene/scene.h"

namespace apps {

/// The name of a surface that differs least from another name. The scene has a surface at least.
const std::string& nearest_surface(const radiosity::Scene& scene, const std::string& name);

}  // namespace apps
