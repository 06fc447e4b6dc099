#pragma once

#include <cstddef>
#include <string_view>

#include "meshing/inspect/inspect.h"
#include "radiosity/scene/scene.h"

namespace apps {

/// "none", "radiance", "exitance", "power", "temperature", "heat_flux" or
/// "heat_power", as in scene files.
constexpr std::string_view emission_name(radiosity::Emission::Kind kind) {
  switch (kind) {
    case radiosity::Emission::Kind::none:
      return "none";
    case radiosity::Emission::Kind::radiance:
      return "radiance";
    case radiosity::Emission::Kind::exitance:
      return "exitance";
    case radiosity::Emission::Kind::power:
      return "power";
    case radiosity::Emission::Kind::temperature:
      return "temperature";
    case radiosity::Emission::Kind::heat_flux:
      return "heat_flux";
    case radiosity::Emission::Kind::heat_power:
      return "heat_power";
  }
  return "";
}

/// "note", "warning" or "serious".
constexpr std::string_view severity_name(meshing::Finding::Severity severity) {
  switch (severity) {
    case meshing::Finding::Severity::note:
      return "note";
    case meshing::Finding::Severity::warning:
      return "warning";
    case meshing::Finding::Severity::serious:
      return "serious";
  }
  return "";
}

/// How many times the scene its whole is: 1 if it has no symmetry.
inline std::size_t n_parts(const radiosity::Scene& scene) {
  return radiosity::image_motions(scene.symmetry).size() + 1;
}

}  // namespace apps
