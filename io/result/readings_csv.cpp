#include "io/result/readings_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::PointPlace;

const char* place_name(PointPlace place) {
  switch (place) {
    case PointPlace::open:
      return "open";
    case PointPlace::inside:
      return "inside";
    case PointPlace::outside:
      return "outside";
  }
  return "";
}

std::string reading_row(const Reading& reading, const Eigen::VectorXd& luminous_weights) {
  const radiosity::Vec3& x = reading.position;
  const radiosity::Vec3& n = reading.normal;
  std::string row =
      fmt::format("{},{},{},{},{},{},{},{},{}", csv_field(reading.name), csv_field(reading.surface),
                  x[0], x[1], x[2], n[0], n[1], n[2], place_name(reading.place));
  const bool is_open = reading.place == PointPlace::open;
  const auto add = [&](double value) { row += is_open ? fmt::format(",{}", value) : ","; };
  if (luminous_weights.size() > 0) add(luminous_weights.dot(reading.irradiance));
  for (const double value : reading.irradiance) add(value);
  return row + '\n';
}

}  // namespace

void write_readings_csv(const std::filesystem::path& path, std::span<const Reading> readings,
                        const Eigen::VectorXd& luminous_weights) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "name,surface,x,y,z,normal_x,normal_y,normal_z,place";
    if (luminous_weights.size() > 0) stream << ",illuminance";
    const Index n_bands = readings.empty() ? 0 : readings.front().irradiance.size();
    for (Index band = 0; band < n_bands; ++band) stream << ",H_" << band;
    stream << '\n';
    for (const Reading& reading : readings) stream << reading_row(reading, luminous_weights);
  });
}

}  // namespace io
