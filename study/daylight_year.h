#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/sky.h"
#include "study/daylight.h"

namespace study {

/// The half sphere above the horizon in spherical triangles: 4 n² of them, each octant along lines
/// that divide its edges in n. Great circles on all sides, so that what is seen of each is exact.
struct SkyParts {
  std::vector<radiosity::ConvexPolygon> triangles;  ///< counter-clockwise as seen from outside
  std::vector<radiosity::Vec3> middles;             ///< unit length
  std::vector<double> solid_angles;                 ///< sr
  std::vector<double> sections;                     ///< ∫ cosZ dω, sr; they add up to π

  [[nodiscard]] radiosity::Index size() const {
    return static_cast<radiosity::Index>(triangles.size());
  }
};
/// At least `n_parts`: 144 for 145 (as Tregenza's), 576 for 577 (as Reinhart's).
SkyParts make_sky_parts(const radiosity::Vec3& up, int n_parts);

/// Irradiance at points of a unit radiance of each part of the sky, and of the ground (daylight
/// coefficients, Tregenza & Waters 1983), of one band: sr. Any sky's light is a product with them.
struct DaylightCoefficients {
  SkyParts parts;
  Eigen::MatrixXd straight;          ///< n_points x n_parts, from the sky itself
  Eigen::MatrixXd reflected;         ///< n_points x n_parts, by way of surfaces
  Eigen::VectorXd straight_ground;   ///< n_points
  Eigen::VectorXd reflected_ground;  ///< n_points
};

struct YearOptions {
  int n_parts = 145;        ///< of the sky, at least
  double tolerance = 1e-3;  ///< of the iteration
};

/// Solves for each part of the sky, and gathers. `study` has no light; its scene has a sky, whose
/// distribution does not matter. Reflectances are means over the bands by `weights`. Throws
/// MemoryShortage, SolveError, Interrupted.
DaylightCoefficients daylight_coefficients(const Study& study,
                                           std::span<const DaylightPoint> points,
                                           const Eigen::VectorXd& weights,
                                           const YearOptions& options = {},
                                           const radiosity::Progress& progress = {});

/// The light of an hour, in the unit that the results shall have.
struct SkyHour {
  radiosity::SkyDistribution distribution;
  radiosity::Vec3 towards_sun = radiosity::Vec3::UnitZ();
  double diffuse = 0;  ///< E_h of the sky alone
  double direct = 0;   ///< E_n of the sun
};

/// Irradiance at the points in each hour, n_hours x n_points. The sky has its mean over each part;
/// the sun's light at a point is exact, with sharp shadows and panes, what surfaces send on of it
/// counts as if it came from all of the part that it stands in. Throws Interrupted.
Eigen::MatrixXd irradiance_in_hours(const Study& study, const DaylightCoefficients& coefficients,
                                    std::span<const DaylightPoint> points,
                                    std::span<const SkyHour> hours, const Eigen::VectorXd& weights,
                                    const radiosity::Progress& progress = {});

}  // namespace study
