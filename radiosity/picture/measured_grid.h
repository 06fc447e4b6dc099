#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/picture/point_grid.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Where a point of a work plane lies.
enum class PointPlace {
  open,    ///< in the space that is lit: it is measured
  inside,  ///< in a solid or a wall
  outside  ///< beyond the floor, if there is one
};

/// The place of a point with a unit normal. It should be a little above what it may lie on. `down`:
/// the direction, unit, in which a point outside has nothing; absent: none is outside.
PointPlace point_place(const Visibility& visibility, const Vec3& point, const Vec3& normal,
                       const std::optional<Vec3>& down);

/// The light on a grid of points.
struct MeasuredGrid {
  PointGrid grid;
  std::vector<PointPlace> places;  ///< per point
  Eigen::MatrixXd irradiance;  ///< of the side it looks to, W/m², n x b; 0 where none is measured
};

/// Measures the light on a grid by the final gather, exactly for radiosity that is constant on each
/// patch. `visibility` is that of the gather's mesh, `down` as for `point_place`. Same input, same
/// bits, at any number of threads. Reports "points"; throws Interrupted.
MeasuredGrid measure(const FinalGather& gather, const Visibility& visibility, const PointGrid& grid,
                     const std::optional<Vec3>& down, const Progress& progress = {});

/// What lighting standards ask of the points that are measured.
struct GridSummary {
  Index n = 0;         ///< points that are measured
  Index n_inside = 0;  ///< that lie in solids
  Index n_outside = 0;
  double mean = 0;  ///< of equal cells; 0 if there are none
  double least = 0;
  double greatest = 0;
  Index least_at = -1;  ///< the first point that has the least; -1 if there are none
  Index greatest_at = -1;

  /// Uniformity U_0, and the diversity's inverse; 0 in darkness.
  [[nodiscard]] double least_to_mean() const { return mean > 0 ? least / mean : 0; }
  [[nodiscard]] double least_to_greatest() const { return greatest > 0 ? least / greatest : 0; }
};

/// `values` has one per point, in any unit.
GridSummary summary(const std::vector<PointPlace>& places, const Eigen::VectorXd& values);

}  // namespace radiosity
