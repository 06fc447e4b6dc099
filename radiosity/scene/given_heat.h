#pragma once

#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Temperatures or net heats that single patches or polygons have in place of what their materials
/// say.
struct GivenHeat {
  enum class Kind {
    temperature,  ///< K
    heat_flux     ///< B - H, W/m²
  };
  enum class Of {
    patches,   ///< by their number
    polygons,  ///< by that of the scene's polygon that a patch is part of, both sides of it
    cells      ///< of all: patches if there are as many, else polygons if there are as many
  };
  Kind kind = Kind::temperature;
  Of of = Of::patches;
  std::vector<std::pair<Index, double>> values;  ///< number from 0, and what is given; NaN: nothing
  std::string source;                            ///< where they come from, for messages
};

}  // namespace radiosity
