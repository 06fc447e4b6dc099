#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "apps/run/weather_hours.h"
#include "study/daylight.h"

namespace apps {

/// What the hours of a year give points, n_hours x n_points of WeatherHours::hours, lx or W/m².
Eigen::MatrixXd illuminance_of_hours(const WeatherHours& weather, const Eigen::MatrixXd& of_skies);

/// Of a point: the mean of all hours, the share of them with at least a threshold (daylight
/// autonomy), and with at least 100 and at most 3000 lx (useful daylight).
struct PointYear {
  double mean = 0;
  double autonomy = 0;
  double useful = 0;
};
std::vector<PointYear> points_of_year(const Eigen::MatrixXd& illuminance, double threshold);

/// Share of points whose autonomy is at least a half: spatial daylight autonomy (IES LM-83).
double spatial_autonomy(std::span<const PointYear> points);

/// Writes a line for each hour under the header month,day,hour,E_0,...: what each point gets in the
/// hour that ends then. Throws OutputError.
void write_hours_csv(const std::filesystem::path& path, const WeatherHours& weather,
                     const Eigen::MatrixXd& illuminance);

}  // namespace apps
