#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"

namespace io {

/// Writes one row per patch under the header
/// patch,surface,polygon,x,y,z,area,B_0..,H_0..,error_0..,net_0..: surface is its name (quoted by
/// RFC 4180 where it must be), x, y, z the centroid (m), area in m², the rest in W/m² per band, net
/// being B - H. Columns of `quantities` follow: `luminance`, or per band `radiance_0`... Numbers
/// read back as the same double. Throws OutputError.
void write_patch_csv(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                     const radiosity::Solution& solution,
                     const std::vector<radiosity::QuantityField>& quantities = {});

}  // namespace io
