#include "apps/run/daylight_hours.h"

#include <fmt/format.h>

#include <fstream>

#include "io/base/atomic_file.h"

namespace apps {
namespace {

using radiosity::Index;

/// Useful daylight (Nabil & Mardaljevic 2005, as revised in 2012), lx.
constexpr double kLeastUseful = 100;
constexpr double kMostUseful = 3000;
constexpr double kAutonomous = 0.5;

}  // namespace

Eigen::MatrixXd illuminance_of_hours(const WeatherHours& weather, const Eigen::MatrixXd& of_skies) {
  const auto n_hours = static_cast<Index>(weather.hours.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_hours, of_skies.cols());
  for (Index h = 0; h < n_hours; ++h) {
    const std::ptrdiff_t sky = weather.light[static_cast<std::size_t>(h)];
    if (sky >= 0) result.row(h) = of_skies.row(sky);
  }
  return result;
}

std::vector<PointYear> points_of_year(const Eigen::MatrixXd& illuminance, double threshold) {
  std::vector<PointYear> result;
  for (Index p = 0; p < illuminance.cols(); ++p) {
    const auto values = illuminance.col(p).array();
    const auto n = static_cast<double>(values.size());
    result.push_back(
        {.mean = values.mean(),
         .autonomy = static_cast<double>((values >= threshold).count()) / n,
         .useful =
             static_cast<double>((values >= kLeastUseful && values <= kMostUseful).count()) / n});
  }
  return result;
}

double spatial_autonomy(std::span<const PointYear> points) {
  const auto n = std::count_if(points.begin(), points.end(),
                               [](const PointYear& p) { return p.autonomy >= kAutonomous; });
  return points.empty() ? 0 : static_cast<double>(n) / static_cast<double>(points.size());
}

void write_hours_csv(const std::filesystem::path& path, const WeatherHours& weather,
                     const Eigen::MatrixXd& illuminance) {
  io::write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "month,day,hour";
    for (Index p = 0; p < illuminance.cols(); ++p) stream << ",E_" << p;
    stream << '\n';
    for (Index h = 0; h < illuminance.rows(); ++h) {
      const io::WeatherHour& hour = weather.hours[static_cast<std::size_t>(h)];
      stream << fmt::format("{},{},{}", hour.month, hour.day, hour.hour);
      for (Index p = 0; p < illuminance.cols(); ++p) {
        stream << fmt::format(",{:.6g}", illuminance(h, p));
      }
      stream << '\n';
    }
  });
}

}  // namespace apps
