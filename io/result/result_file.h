#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"

namespace io {

/// What a result file needs to know beyond the solution.
struct ResultOptions {
  /// What the bands are, for the colours of a .ply or .glb and for who reads a .vtp; absent: one is
  /// grey, three are linear RGB, any other number shows as grey.
  std::optional<radiosity::Bands> bands = {};
  /// Added to every file: after the columns of a .csv (`name`, per band `name_0`..), as arrays of a
  /// .vtp. The first one, its mean over the bands, colours a .ply or .glb through `fitting_scale`
  /// and `map_color` instead of the radiosity.
  std::vector<radiosity::QuantityField> quantities = {};
  /// From which the scene is to be looked at; a .vtp keeps it.
  std::optional<radiosity::Camera> camera = {};
};

/// Writes a solution by extension: .vtp (ParaView: cell arrays radiosity, irradiance, exitance,
/// reflectance, surface, polygon, area, radiosity_error, net_flux, twin, family, and what else
/// `read_result` needs), .csv (one row per patch, header
/// patch,surface,polygon,x,y,z,area,B_0..,H_0..,error_0..,net_0..) .ply (smooth vertex colours,
/// sRGB) or .glb (glTF with the same colours, for any viewer). The file is written beside and
/// renamed into place, so there is never half a file. Throws OutputError naming the file if it
/// cannot be written or the extension is none of these. Programs that do not link radiosity::vtk
/// cannot write .vtp: to them it is none of these.
void write(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
           const radiosity::Solution& solution, const ResultOptions& options = {});

}  // namespace io
