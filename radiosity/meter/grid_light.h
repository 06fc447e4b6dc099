#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/meter/measuring_points.h"
#include "radiosity/meter/photometer.h"
#include "radiosity/picture/measured_grid.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Something that is measured at every point.
struct GridQuantity {
  std::string name;  ///< "illuminance", "cylindrical", "vertical 1,0,0", "luminance 0,0,1.5" ...
  Eigen::MatrixXd values;  ///< n_points x Photometer::n_columns; 0 where none is measured
  std::string unit = "lx";

  [[nodiscard]] std::string name_with_unit() const { return name + ", " + unit; }

  /// Direct and indirect light together, n_points; `light` counts from 0.
  [[nodiscard]] Eigen::VectorXd total(Index light) const {
    return values.col(kLightParts * light) + values.col(kLightParts * light + 1);
  }
  [[nodiscard]] Eigen::VectorXd part(Index light, LightPart which) const {
    return values.col(kLightParts * light + static_cast<Index>(which));
  }
};

/// "vertical 0,1,0": what is measured, and a direction or a point.
std::string quantity_name(const char* what, const Vec3& vector);

/// The light at the points of a plan.
struct GridLight {
  MeasuringPoints where;
  std::vector<PointPlace> places;        ///< per point
  std::vector<GridQuantity> quantities;  ///< the first is the illuminance of the points' planes
};

/// Measures what a plan asks for. `down` as for `point_place`. Same input, same bits, at any number
/// of threads. Reports "points"; throws as make_measuring_points does, and Interrupted.
GridLight measure_grid(const GridPlan& plan, const PatchMesh& mesh, const Visibility& visibility,
                       const Photometer& photometer, const std::optional<Vec3>& down,
                       const Progress& progress = {});

}  // namespace radiosity
