#pragma once

#include <filesystem>

#include "io/result/color_ply.h"
#include "io/result/glb_file.h"
#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Writes the patches as binary glTF 2.0 that shows the colours as they are (vertex colours, linear
/// as glTF wants them, in 16 bits; KHR_materials_unlit), with a node for each surface.
/// Coordinates (m) are rounded to float. Throws OutputError, also if the file would be larger than
/// the format allows (4 GB).
void write_color_glb(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                     const CornerColors& colors, UpAxis up = UpAxis::y);

}  // namespace io
