#pragma once

#include <string_view>

#include "radiosity/scene/scene.h"

namespace io {

/// What the field "bands" of a .vtp calls them.
inline std::string_view bands_name(radiosity::Bands::Kind kind) {
  using Kind = radiosity::Bands::Kind;
  switch (kind) {
    case Kind::grey:
      return "grey";
    case Kind::rgb:
      return "rgb";
    case Kind::solar_infrared:
      return "solar-infrared";
    case Kind::thermal:
      return "thermal";
    case Kind::wavelengths:
      break;
  }
  return "wavelengths";
}

}  // namespace io
