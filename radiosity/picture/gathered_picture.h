#pragma once

#include "radiosity/picture/final_gather.h"
#include "radiosity/picture/render.h"
#include "radiosity/scene/patch_texture.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// What diffuse surfaces do, n_patches x n_bands each.
struct SurfaceLight {
  const Eigen::MatrixXd& exitance;     ///< M_e, W/m²
  const Eigen::MatrixXd& reflectance;  ///< ρ in [0, 1]
  TextureMap textures = {};            ///< what points of patches reflect in place of that
};

/// The picture that `render` makes, with the radiosity of each visible point gathered anew from the
/// patches: B(x) = M_e + ρ(x) H(x), H(x) from `gather`. Shadows and contacts come out finer than
/// the patches; surfaces of curved shape show their facets. The rays of a pixel that meet one plane
/// share a gather, at the mean of their points or, if others meet something else, at the point
/// nearest to it. `crease_angle` is not used. Same input, same picture, at any number of threads.
/// Throws Interrupted if asked to stop.
Image render_gathered(const FinalGather& gather, const Visibility& visibility,
                      const SurfaceLight& light, const Camera& camera,
                      const RenderOptions& options = {});

}  // namespace radiosity
