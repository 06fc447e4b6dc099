#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/picture/measured_grid.h"

namespace io {

/// The light that arrives at a point.
struct Reading {
  std::string name;
  std::string surface;                                 ///< that it lies on; "" in free space
  radiosity::Vec3 position = radiosity::Vec3::Zero();  ///< m
  radiosity::Vec3 normal = radiosity::Vec3::Zero();    ///< of the side that is measured
  radiosity::PointPlace place = radiosity::PointPlace::open;
  Eigen::VectorXd irradiance;  ///< W/m² per band
};

/// Writes one row per point under the header
/// name,surface,x,y,z,normal_x,normal_y,normal_z,place,illuminance,H_0..: x, y, z in m; place is
/// `open`, `inside` a solid or `outside` the floor; where it is not open what follows is empty.
/// Illuminance is the bands' irradiance by `luminous_weights`, lux; without weights (heat) there is
/// no such column. Numbers read back as the same double. Throws OutputError.
void write_readings_csv(const std::filesystem::path& path, std::span<const Reading> readings,
                        const Eigen::VectorXd& luminous_weights);

}  // namespace io
