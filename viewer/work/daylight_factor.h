#pragma once

#include "radiosity/scene/scene.h"
#include "study/measured_plan.h"
#include "study/study_events.h"
#include "study/study_options.h"

namespace viewer {

inline constexpr const char* kDaylightFactor = "daylight factor";

/// Whether there are daylight factors: the scene has a sky that gives light that is seen.
bool has_daylight_factors(const radiosity::Scene& scene);

/// Adds to each grid of a plan its daylight factor, the illuminance by the sky alone as a share of
/// what that gives an unobstructed horizontal surface (CIE 17-279), in %, with one standard error.
/// It does not depend on how bright the sky is, nor on lamps. `lit` has the sky that is meant; its
/// solution is not used. Solves for that light. Throws SolveError, Interrupted.
void add_daylight_factors(const study::LitScene& lit, study::MeasuredPlan& measured,
                          const study::StudyOptions& options, const study::StudyEvents& events);

}  // namespace viewer
