#pragma once

#include <filesystem>

#include "radiosity/base/progress.h"
#include "radiosity/scene/given_heat.h"

namespace io {

/// Reads temperatures (K) or heat fluxes (W/m²) of patches or polygons.
///  - .csv: the first row names the columns. Numbers are in `patch`, or without it in `polygon`;
///    temperatures in `temperature`, `surface_temperature`, `T` or `value`, heat fluxes in
///    `heat_flux` or `value`. Others are skipped, so that a result of `solve` will do. A row whose
///    value is empty gives nothing.
///  - .vtp, .vtu, .vtk: cell data `temperature` or `surface_temperature`, or `heat_flux`; NaN gives
///    nothing.
/// Throws SceneError with the file, and the line of a .csv; Interrupted.
radiosity::GivenHeat read_given_heat(const std::filesystem::path& path,
                                     radiosity::GivenHeat::Kind kind,
                                     const radiosity::Progress& progress = {});

}  // namespace io
