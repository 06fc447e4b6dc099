#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/picture/point_grid.h"
#include "study/daylight.h"
#include "study/study.h"

namespace apps {

/// Points of a CSV file: a line x,y,z or x,y,z,nx,ny,nz each, m; without a normal they look up.
/// Lines that start with # and a first line of names are passed over. Throws SceneError with file
/// and line.
std::vector<study::DaylightPoint> read_points(const std::filesystem::path& path,
                                              const radiosity::Vec3& up,
                                              const radiosity::Progress& progress);

/// The points of a work plane of the study's room; its sky tells what is up.
std::vector<study::DaylightPoint> plane_points(const study::Study& study,
                                               const radiosity::WorkPlaneOptions& options);

/// Writes a line for each point under the header
/// x,y,z,normal_x,normal_y,normal_z,place,daylight_factor,sky,external,internal,error: m and shares
/// of E_h; place is `open`, or `inside` a solid, where what follows is empty. Throws OutputError.
void write_daylight_csv(const std::filesystem::path& path,
                        std::span<const study::DaylightPoint> points,
                        std::span<const radiosity::PointPlace> places,
                        std::span<const study::DaylightFactor> factors);

}  // namespace apps
