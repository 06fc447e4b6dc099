#pragma once

#include <filesystem>

#include "radiosity/meter/grid_light.h"

namespace io {

/// Writes points of measured light as VTK XML polydata in text: a quad for each cell of a grid, a
/// vertex for each point of a list, with cell data `place` (0 open, 1 inside a solid, 2 outside)
/// and, for each quantity of each light, what `write_grid_csv` has under the same names, lux; NaN
/// where none is measured. Throws OutputError.
void write_grid_vtp(const std::filesystem::path& path, const radiosity::GridLight& light);

}  // namespace io
