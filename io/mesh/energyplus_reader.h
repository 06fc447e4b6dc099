#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"
#include "radiosity/base/progress.h"

namespace io {

/// Reads an input file of EnergyPlus (.idf, .epJSON) as a scene: a surface for each surface and
/// window, which face their zones, windows cut out of their walls. Grey, with the emissivities of
/// the constructions' innermost layers. Coordinates in metres. Throws SceneError as
/// `read_energyplus_model` does, and for windows that do not lie in their walls.
FileScene read_energyplus(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
