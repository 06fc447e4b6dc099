#pragma once

#include <filesystem>

#include "io/picture/image_file.h"
#include "io/result/glb_file.h"
#include "radiosity/picture/light_atlas.h"
#include "radiosity/picture/render.h"
#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Writes the patches as binary glTF 2.0 that shows a lightmap of theirs, the radiance in the
/// texels of `atlas`, as `srgb_picture` shows it; the PNG is in the file. Corners that patches of
/// one chart share are one vertex. Coordinates (m) are rounded to float. Throws OutputError.
void write_lightmap_glb(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const radiosity::LightAtlas& atlas, const radiosity::Image& lightmap,
                        const ImageOptions& options = {}, UpAxis up = UpAxis::y);

}  // namespace io
