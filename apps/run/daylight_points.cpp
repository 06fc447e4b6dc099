#include "apps/run/daylight_points.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "io/base/atomic_file.h"
#include "io/base/line_reader.h"

namespace apps {
namespace {

using radiosity::Vec3;

/// The numbers of a line; none if a field is no number.
std::optional<std::vector<double>> numbers_in(std::string_view line) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = line.find(',');
    const auto number = io::parse_number<double>(io::trimmed(line.substr(0, comma)));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    line.remove_prefix(comma + 1);
  }
}

study::DaylightPoint point_of(const io::LineReader& reader, const std::vector<double>& numbers,
                              const Vec3& up) {
  if (numbers.size() != 3 && numbers.size() != 6) {
    reader.fail(fmt::format("has {} numbers, expected x,y,z or x,y,z,nx,ny,nz", numbers.size()));
  }
  study::DaylightPoint point{Vec3(numbers[0], numbers[1], numbers[2]), up};
  if (numbers.size() == 3) return point;
  const Vec3 normal(numbers[3], numbers[4], numbers[5]);
  const double length = normal.stableNorm();
  if (!(length > 0)) reader.fail("the normal is 0");
  point.normal = normal / length;
  return point;
}

}  // namespace

std::vector<study::DaylightPoint> read_points(const std::filesystem::path& path, const Vec3& up,
                                              const radiosity::Progress& progress) {
  io::LineReader reader(path, progress);
  std::vector<study::DaylightPoint> points;
  bool is_first = true;
  while (reader.next_content()) {
    const auto numbers = numbers_in(reader.line());
    if (numbers) {
      points.push_back(point_of(reader, *numbers, up));
    } else if (!is_first) {
      reader.fail("expected numbers between commas: x,y,z or x,y,z,nx,ny,nz");
    }
    is_first = false;
  }
  if (points.empty()) io::fail(path, "has no points");
  return points;
}

std::vector<study::DaylightPoint> plane_points(const study::Study& study,
                                               const radiosity::WorkPlaneOptions& options) {
  const radiosity::PointGrid grid =
      radiosity::make_work_plane(study.mesh, study.scene.sky->up, options);
  std::vector<study::DaylightPoint> points;
  for (Index k = 0; k < grid.size(); ++k) points.push_back({grid.point(k), grid.normal()});
  return points;
}

void write_daylight_csv(const std::filesystem::path& path,
                        std::span<const study::DaylightPoint> points,
                        std::span<const radiosity::PointPlace> places,
                        std::span<const study::DaylightFactor> factors) {
  io::write_stream_atomically(path, [&](std::ofstream& stream) {
    stream
        << "x,y,z,normal_x,normal_y,normal_z,place,daylight_factor,sky,external,internal,error\n";
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec3& x = points[k].position;
      const Vec3& n = points[k].normal;
      stream << fmt::format("{},{},{},{},{},{},", x[0], x[1], x[2], n[0], n[1], n[2]);
      if (places[k] != radiosity::PointPlace::open) {
        stream << "inside,,,,,\n";
        continue;
      }
      const study::DaylightFactor& there = factors[k];
      stream << fmt::format("open,{},{},{},{},{}\n", there.total(), there.sky, there.external,
                            there.internal, there.error);
    }
  });
}

}  // namespace apps
