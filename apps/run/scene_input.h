#pragma once

#include "apps/options/common_options.h"
#include "radiosity/scene/scene.h"
#include "study/study.h"

namespace apps {

/// Reads the scene; what the reader noticed becomes warnings.
radiosity::Scene read_scene_warning(const CommonOptions& common, const study::StudyEvents& events);

/// The same; throws SceneError if the scene has no polygons.
radiosity::Scene read_checked_scene(const CommonOptions& common, const study::StudyEvents& events);

}  // namespace apps
