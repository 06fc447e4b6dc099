#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"

namespace io {

/// A wall, floor or ceiling of a zone, or a window or door in one.
struct EnergyPlusSurface {
  std::string name;
  /// What it exchanges radiation in: its space, or its zone if that is not divided into spaces, by
  /// the name of their object; what is in no space of a divided zone is in its "...-Remainder".
  std::string enclosure{};
  int base = -1;            ///< of a window: the surface that it is in, an earlier one
  std::string material{};   ///< of the side towards the zone
  double emissivity = 0.9;  ///< of that material
  std::vector<radiosity::Vec3> corners{};  ///< counter-clockwise seen from the zone, m
};

/// What radiates in the zones of a building.
struct EnergyPlusModel {
  std::vector<EnergyPlusSurface> surfaces;  ///< walls in the file's order, then windows
  std::vector<std::string> warnings;
};

/// Reads an input file of EnergyPlus, .idf or .epJSON: zones, spaces, surfaces by their corners,
/// windows and the emissivities of the innermost layers of constructions. Coordinates are relative
/// to the zones or not, as the file says; the building's own north is left out. Throws SceneError
/// with the object where something is missing, contradicts itself or is there twice, in whatever
/// case, where surfaces are given in other ways than by their corners, and for boundaries of air
/// between zones and multiplied windows; Interrupted.
EnergyPlusModel read_energyplus_model(const std::filesystem::path& path,
                                      const radiosity::Progress& progress);

}  // namespace io
