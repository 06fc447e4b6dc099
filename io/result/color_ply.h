#pragma once

#include <filesystem>
#include <vector>

#include "io/result/colored_mesh.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"

namespace io {

/// The radiosity as `display_colors` shows it, exposed for the patches that do not emit.
CornerColors radiosity_colors(const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                              const std::vector<double>& wavelengths = {});

/// A quantity, its mean over the bands, through the colour map over the scale that fits.
CornerColors quantity_colors(const radiosity::PatchMesh& mesh,
                             const radiosity::QuantityField& quantity,
                             const std::vector<double>& wavelengths = {});

/// Writes the patches as binary PLY with smooth vertex colours. A vertex appears once per colour.
/// Coordinates (m) are rounded to float. Throws OutputError.
void write_color_ply(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                     const CornerColors& colors);

}  // namespace io
