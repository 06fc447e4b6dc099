#pragma once

#include <string>

#include "radiosity/scene/scene.h"

namespace apps {

/// The name of a surface of the scene, which has one at least, that differs least from another name.
const std::string& nearest_surface(const radiosity::Scene& scene, const std::string& name);

}  // namespace apps
