#pragma once

#include "radiosity/picture/light_atlas.h"
#include "radiosity/picture/render.h"
#include "radiosity/scene/scene.h"
#include "study/study.h"

namespace study {

/// Where the light of a picture's points comes from.
enum class Shading {
  interpolated,  ///< from the patches (radiosity::render)
  gathered       ///< gathered anew at each point (radiosity::render_gathered)
};

/// The radiance that a camera sees of a study that is solved. Throws Interrupted.
radiosity::Image draw(const Study& study, const radiosity::Camera& camera, Shading shading,
                      const radiosity::RenderOptions& options = {});

/// The radiance at the texels of an atlas of its patches. Of `options` only the crease angle and
/// progress count. Throws Interrupted.
radiosity::Image draw_lightmap(const Study& study, const radiosity::LightAtlas& atlas,
                               Shading shading, const radiosity::RenderOptions& options = {});

}  // namespace study
