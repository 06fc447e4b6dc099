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

/// Throws SceneError, which says why, if the camera has no patch's emitting side before it. Takes
/// no rays, so that it can be asked before the light is known. `aspect` is the width / height.
void refuse_empty_view(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                       const radiosity::Camera& camera, double aspect);

/// Throws SceneError if no pixel shows anything.
void refuse_empty(const radiosity::Image& image);

/// The radiance that a camera sees of a study that is solved. Throws SceneError as the two above,
/// and Interrupted.
radiosity::Image draw(const Study& study, const radiosity::Camera& camera, Shading shading,
                      const radiosity::RenderOptions& options = {});

/// The radiance at the texels of an atlas of its patches. Of `options` only the crease angle and
/// progress count. Throws Interrupted.
radiosity::Image draw_lightmap(const Study& study, const radiosity::LightAtlas& atlas,
                               Shading shading, const radiosity::RenderOptions& options = {});

}  // namespace study
