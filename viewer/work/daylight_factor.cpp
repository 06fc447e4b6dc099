#include "viewer/work/daylight_factor.h"

#include <utility>
#include <vector>

#include "radiosity/meter/grid_light.h"
#include "radiosity/meter/photometer.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/visibility/sky_light.h"
#include "study/daylight.h"
#include "study/study.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr double kPercent = 100;

/// The light on a grid's planes alone.
radiosity::GridPlan planes_of(radiosity::GridPlan plan) {
  plan.is_cylindrical = false;
  plan.vertical.clear();
  plan.semi_cylindrical.clear();
  plan.luminance_from.clear();
  return plan;
}

}  // namespace

bool has_daylight_factors(const radiosity::Scene& scene) {
  return scene.sky && radiosity::luminous_weights(scene.bands).dot(scene.sky->zenith_radiance) > 0;
}

void add_daylight_factors(const study::LitScene& lit, study::MeasuredPlan& measured,
                          const study::StudyOptions& options, const study::StudyEvents& events) {
  if (measured.grids.empty() || !has_daylight_factors(lit.scene)) return;
  const radiosity::Scene scene = study::daylight_scene(lit.scene);
  const radiosity::Solution solution =
      study::solve_light(scene, lit.mesh, lit.transport, options, events).solution;
  const Eigen::VectorXd weights = radiosity::luminous_weights(scene.bands);
  const double outdoors = weights.dot(radiosity::horizontal_irradiance(*scene.sky));
  const std::vector<radiosity::Lighting> lights = {{scene, solution}};
  const radiosity::Photometer photometer(lit.mesh, lights, weights);
  for (study::MeasuredPlanGrid& grid : measured.grids) {
    radiosity::GridLight light =
        radiosity::measure_grid(planes_of(grid.plan), lit.mesh, lit.visibility, photometer,
                                study::down_to_floor(grid.plan, scene, lit.mesh), events.progress);
    radiosity::GridQuantity factor = std::move(light.quantities.front());
    factor.name = kDaylightFactor;
    factor.unit = "%";
    // The same of lamps of any age.
    const Index n_ages = measured.has_maintenance ? 2 : 1;
    factor.values = (kPercent / outdoors * factor.values).replicate(1, n_ages).eval();
    grid.light.quantities.push_back(std::move(factor));
  }
}

}  // namespace viewer
