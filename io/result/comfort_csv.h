#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"

namespace io {

/// A row of a table of radiant temperatures.
struct ComfortRow {
  radiosity::Vec3 position;                    ///< m
  double mean_radiant_temperature = 0;         ///< K
  std::array<double, 6> plane_temperatures{};  ///< up, down, front, back, left, right, K
  Eigen::VectorXd surfaces;                    ///< form factors to these
  double backs = 0;
  double sky = 0;
};

/// Writes `x,y,z,mean_radiant_temperature,up,down,front,back,left,right,F_<surface>...,F_backs,
/// F_sky`, a row for each point; m and K. Throws OutputError.
void write_comfort_csv(const std::filesystem::path& path,
                       const std::vector<std::string>& surface_names,
                       const std::vector<ComfortRow>& rows);

/// Reads points from lines `x,y,z`, m; the first may have these names, others are skipped then.
/// Throws SceneError with the line; Interrupted.
std::vector<radiosity::Vec3> read_points_csv(const std::filesystem::path& path,
                                             const radiosity::Progress& progress = {});

}  // namespace io
