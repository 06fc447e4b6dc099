#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "radiosity/scene/scenario.h"
#include "study/study.h"

namespace study {

/// Takes the study with the scene and the light of a scenario, by its index.
using ScenarioVisitor = std::function<void(std::size_t, const Study&)>;

/// Solves a study that has no light yet for each scenario, those of equal reflectances together in
/// one solve of many columns, and visits each. What a compressed operator lacks of light from their
/// polygons is added first. Returns the study as it was, but for that. Throws SceneError as
/// radiosity::scene_of does, before anything long; SolveError; Interrupted.
Study solve_scenarios(Study study, const std::vector<radiosity::Scenario>& scenarios,
                      const StudyOptions& options, const StudyEvents& events,
                      const ScenarioVisitor& visit);

}  // namespace study
