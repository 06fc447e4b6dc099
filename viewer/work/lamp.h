#pragma once

#include <cstdint>

#include "radiosity/scene/scene.h"

namespace viewer {

/// The scene with a surface that gives so many lumens, spread over the bands alike, from a material
/// of its own that else is what it was. Throws std::out_of_range if there is no such surface or
/// unless lumens are above 0; SceneError if the scene's bands have no light that is seen, or hold
/// heat.
radiosity::Scene with_lamp(const radiosity::Scene& scene, std::int32_t surface, double lumens);

}  // namespace viewer
