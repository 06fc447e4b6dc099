#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/picture/measured_grid.h"
#include "study/study.h"

namespace study {

/// A point of a plane that is measured, m, and the plane's unit normal.
struct DaylightPoint {
  radiosity::Vec3 position = radiosity::Vec3::Zero();
  radiosity::Vec3 normal = radiosity::Vec3::UnitZ();
};

/// The daylight factor of a point and what it is made of, shares of E_h, the illuminance that the
/// sky alone gives an unobstructed horizontal surface (CIE 17-279; BS EN 17037).
struct DaylightFactor {
  double sky = 0;       ///< straight from the sky, through panes as well
  double external = 0;  ///< from the ground and from what stands outdoors
  double internal = 0;  ///< from all other surfaces
  double error = 0;     ///< bound on what quadrature left of light that comes straight

  [[nodiscard]] double total() const { return sky + external + internal; }
};

/// The scene by daylight alone: its sky without sun and luminaires, and nothing that emits. Throws
/// SceneError if it has no sky or if that is dark.
radiosity::Scene daylight_scene(radiosity::Scene scene);

/// Which of the surfaces a pattern (radiosity::matches) stands for. Throws SceneError for one that
/// stands for none.
std::vector<bool> outdoor_surfaces(const std::vector<std::string>& surface_names,
                                   const std::vector<std::string>& patterns);

/// Daylight factors at points, by the final gather: exact for radiosity that is constant on each
/// patch. `study` has the light of a daylight_scene. Surfaces whose names match a pattern of
/// `outdoors` (radiosity::matches) stand outdoors. `weights` make one value of the bands
/// (luminous_weights). Reports "points". Throws SceneError for a pattern that matches nothing;
/// Interrupted.
std::vector<DaylightFactor> daylight_factors(const Study& study,
                                             std::span<const DaylightPoint> points,
                                             const std::vector<std::string>& outdoors,
                                             const Eigen::VectorXd& weights,
                                             const radiosity::Progress& progress = {});

/// Where points lie: `PointPlace::open` or in a solid.
std::vector<radiosity::PointPlace> daylight_places(const Study& study,
                                                   std::span<const DaylightPoint> points);

}  // namespace study
