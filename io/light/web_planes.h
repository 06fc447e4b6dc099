#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "radiosity/scene/photometric_web.h"

namespace io {

/// What files can have of angles of one kind, and of intensities: more is no luminaire.
inline constexpr long kMostAngles = 10000;
inline constexpr long kMostIntensities = 4000000;

/// A web as files give it: angles in degrees, and a column of intensities for each plane.
struct GivenPlanes {
  radiosity::PhotometricWeb::Type type = radiosity::PhotometricWeb::Type::c;
  std::vector<double> vertical;
  std::vector<double> planes;
  Eigen::MatrixXd intensity;  ///< cd, n_vertical x n_planes
};

/// What is wrong with angles that should increase within [least, most] degrees; "" if nothing is.
std::string angle_problem(const std::string& what, const std::vector<double>& angles, double least,
                          double most);

/// Appends the planes' mirror images: plane a becomes `sum` - a. Planes increase; those on the
/// mirror itself stay single.
void mirror_planes(double sum, GivenPlanes& given);

/// The web of planes all around, of type C from 0 to 360 degrees, or single.
radiosity::PhotometricWeb make_web(const GivenPlanes& given);

}  // namespace io
