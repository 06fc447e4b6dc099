#pragma once

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

}  // namespace study
