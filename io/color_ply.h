#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/patch_mesh.h"
#include "radiosity/solve.h"

namespace io {

/// Writes the patches as binary PLY with smooth vertex colours: the radiosity at the patches'
/// corners in 8-bit sRGB (`display_colors`), exposed for the patches that do not emit. A vertex
/// appears once per colour. Coordinates (m) are rounded to float. Throws OutputError.
void write_color_ply(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                     const radiosity::Solution& solution,
                     const std::vector<double>& wavelengths = {});

}  // namespace io
