#pragma once

#include "radiosity/picture/final_gather.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/picture/light_atlas.h"
#include "radiosity/picture/render.h"

namespace radiosity {

/// Radiance π⁻¹ B at the texels of an atlas, W/(m² sr) per band: in the middle of each texel the
/// `corner_values` interpolated within the patch, as `render` shows them. Texels that lie beside
/// their polygon, but so close that what is interpolated within it takes from them, have the value
/// of the nearest point of it; others are 0 and have alpha 0. `radiosity` is n_patches x n_bands.
/// Of `options` only the crease angle and progress (stage "picture", in rows) count. Same input,
/// same picture, at any number of threads. Throws Interrupted if asked to stop.
Image make_lightmap(const PatchMesh& mesh, const LightAtlas& atlas,
                    const Eigen::MatrixXd& radiosity, const RenderOptions& options = {});

/// The same with the light of each texel gathered anew from the patches, as `render_gathered` does
/// in pixels.
Image make_gathered_lightmap(const PatchMesh& mesh, const LightAtlas& atlas,
                             const FinalGather& gather, const SurfaceLight& light,
                             const RenderOptions& options = {});

}  // namespace radiosity
