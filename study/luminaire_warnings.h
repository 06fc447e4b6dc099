#pragma once

#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visibility.h"
#include "study/study_events.h"

namespace study {

/// Of luminaires whose light meets no emitting side: outside of the room, or inside of a solid or a
/// wall. And of those whose opening a surface cuts through.
void warn_of_luminaires(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                        const radiosity::Visibility& visibility, const StudyEvents& events);

}  // namespace study
