#pragma once

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// The "sky" of a scene that has one, as read_sky takes it.
Json sky_json(const radiosity::Scene& scene);

/// The "glazing" of a material, as read_glazing takes it.
Json glazing_json(const radiosity::Glazing& glazing);

}  // namespace io
