#include "python/bindings/daylight.h"

#include "radiosity/solve/quantity.h"
#include "study/daylight.h"

namespace python {

using namespace radiosity;

Eigen::MatrixXd daylight_factors(const study::Study& study, const study::StudyOptions& options,
                                 const Eigen::MatrixXd& points, const Eigen::MatrixXd& normals,
                                 const std::vector<std::string>& outdoors, double efficacy,
                                 const study::StudyEvents& events) {
  study::Study by_day{.scene = study::daylight_scene(study.scene),
                      .mesh = study.mesh,
                      .visibility = Visibility(study.mesh),
                      .transport = nullptr};
  (void)study::outdoor_surfaces(by_day.mesh.surface_names, outdoors);
  by_day.solution =
      study::solve_light(by_day.scene, by_day.mesh, *study.transport, options, events).solution;
  std::vector<study::DaylightPoint> places;
  for (Index k = 0; k < points.rows(); ++k) {
    places.push_back({points.row(k).transpose(), normals.row(k).transpose().normalized()});
  }
  Eigen::VectorXd weights = luminous_weights(by_day.scene.bands, efficacy);
  if (weights.isZero(0)) weights.setOnes();
  const auto factors = study::daylight_factors(by_day, places, outdoors, weights, events.progress);
  Eigen::MatrixXd result(points.rows(), 4);
  for (Index k = 0; k < result.rows(); ++k) {
    const study::DaylightFactor& there = factors[static_cast<std::size_t>(k)];
    result.row(k) << there.sky, there.external, there.internal, there.error;
  }
  return result;
}

}  // namespace python
