#pragma once

#include <optional>
#include <vector>

#include "radiosity/meter/glare.h"
#include "radiosity/meter/grid_light.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/solve/quantity.h"
#include "study/study.h"
#include "study/study_events.h"
#include "study/study_options.h"

namespace study {

/// Which light is meant: that of new lamps, or what is left of it when they are looked after.
enum class LampAge { new_lamps, maintained };

/// A grid of a plan and the light on it.
struct MeasuredPlanGrid {
  radiosity::GridPlan plan;
  radiosity::GridLight light;  ///< columns of new lamps and, if that differs, of maintained ones
};

/// An observer of a plan, and what dazzles new lamps do.
struct MeasuredObserver {
  radiosity::Observer observer;
  radiosity::Glare glare;
};

/// All that a plan asks for.
struct MeasuredPlan {
  bool has_maintenance = false;   ///< whether maintained light differs from that of new lamps
  double maintenance_factor = 1;  ///< of all lamps, as the plan has it
  /// By surface: the share of its own light that is left.
  std::vector<double> maintenance_factors;
  std::vector<double> luminaire_factors;  ///< the same of each luminaire
  std::vector<MeasuredPlanGrid> grids;
  std::vector<MeasuredObserver> observers;

  /// Which of a grid's lights has that age.
  [[nodiscard]] radiosity::Index light(LampAge age) const {
    return age == LampAge::maintained && has_maintenance ? 1 : 0;
  }
  /// The largest UGR of all observers; empty if nothing dazzles any of them.
  [[nodiscard]] std::optional<double> largest_ugr() const;
};

/// A scene with its light, that others own.
struct LitScene {
  const radiosity::Scene& scene;
  const radiosity::PatchMesh& mesh;
  const radiosity::Visibility& visibility;
  const radiosity::Transport& transport;
  const radiosity::Solution& solution;
};

/// The way to the floor, a unit vector, if a point of this grid with nothing there is outside.
/// Planes are above the floor where nothing tells which way is up; those of surfaces end with them.
/// Listed points are where they are wanted if the sky lights them.
std::optional<radiosity::Vec3> down_to_floor(const radiosity::GridPlan& grid,
                                             const radiosity::Scene& scene,
                                             const radiosity::PatchMesh& mesh);

/// Measures what a plan asks for in a scene that has its light; of maintained lamps, whose light is
/// solved anew by the same form factors, if any factor is below 1. Light of sun and environment
/// does not age. `efficacy` as for luminous_weights. Warns of points in solids and outside, of
/// an environment, which points do not see, and of glare sources beyond what CIE 117 is for. Throws
/// SceneError as make_measuring_points does, if the light is heat, SolveError, Interrupted.
MeasuredPlan measure_plan(const LitScene& solved, const radiosity::LightPlan& plan,
                          const StudyOptions& options = {},
                          double efficacy = radiosity::kWhiteEfficacy,
                          const StudyEvents& events = {});
/// The same of a study.
MeasuredPlan measure_plan(const Study& solved, const radiosity::LightPlan& plan,
                          const StudyOptions& options = {},
                          double efficacy = radiosity::kWhiteEfficacy,
                          const StudyEvents& events = {});

}  // namespace study
