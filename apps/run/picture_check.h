#pragma once

#include "apps/options/common_options.h"
#include "apps/terminal/terminal_progress.h"
#include "radiosity/scene/scene.h"
#include "study/study.h"

namespace apps {

/// Before the long work: throws SceneError if the picture would be empty, and
/// CLI::ValidationError if the options ask for a camera or a band that cannot be; warns if it would
/// mislead since the camera is inside a solid, and if nobody placed the camera.
void check_picture(const radiosity::Scene& scene, const study::Patches& patches,
                   const PictureOptions& options, TerminalProgress& terminal);

}  // namespace apps
