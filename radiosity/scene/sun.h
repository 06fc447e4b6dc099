#pragma once

#include <Eigen/Core>
#include <optional>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Parallel light from outside of the scene: the sun as a point infinitely far away.
struct Sun {
  Vec3 direction = Vec3(0, 0, -1);  ///< in which its light travels, unit length
  /// E_n on a surface normal to the beam, per band, W/m² (of wavelengths W/(m² nm)), >= 0.
  Eigen::VectorXd irradiance;
};

/// The direction in which light travels from a sun at `elevation` above the horizon, in [-π/2, π/2]
/// radian, and at `azimuth` from north by east (clockwise seen from above), radian. `up` and
/// `north` are unit vectors; of `north` the part normal to `up` counts.
Vec3 sun_direction(double azimuth, double elevation, const Vec3& up, const Vec3& north);

/// The north that goes with `up` if nobody says otherwise, normal to it and of unit length: +y, as
/// on a map, where z is up; -z, away from the viewer, where y is up; else what of +y is horizontal.
Vec3 usual_north(const Vec3& up);

}  // namespace radiosity
