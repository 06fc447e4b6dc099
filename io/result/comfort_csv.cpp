#include "io/result/comfort_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"
#include "io/base/line_reader.h"

namespace io {

void write_comfort_csv(const std::filesystem::path& path,
                       const std::vector<std::string>& surface_names,
                       const std::vector<ComfortRow>& rows) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "x,y,z,mean_radiant_temperature,up,down,front,back,left,right";
    for (const std::string& name : surface_names) stream << ',' << csv_field("F_" + name);
    stream << ",F_backs,F_sky\n";
    for (const ComfortRow& row : rows) {
      std::string line;
      const auto add = [&](double value) {
        fmt::format_to(std::back_inserter(line), "{}{}", line.empty() ? "" : ",", value);
      };
      for (const double x : row.position) add(x);
      add(row.mean_radiant_temperature);
      for (const double kelvin : row.plane_temperatures) add(kelvin);
      for (const double factor : row.surfaces) add(factor);
      add(row.backs);
      add(row.sky);
      stream << line << '\n';
    }
  });
}

std::vector<radiosity::Vec3> read_points_csv(const std::filesystem::path& path,
                                             const radiosity::Progress& progress) {
  LineReader reader(path, progress);
  std::vector<radiosity::Vec3> points;
  std::array<std::size_t, 3> columns = {0, 1, 2};
  std::size_t n_columns = 3;
  for (bool is_first = true; reader.next_content(); is_first = false) {
    const auto fields = comma_fields(reader.line());
    if (is_first && std::find(fields.begin(), fields.end(), "x") != fields.end()) {
      n_columns = fields.size();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto found = std::find(fields.begin(), fields.end(), std::string(1, "xyz"[axis]));
        if (found == fields.end()) reader.fail(fmt::format("has no column {}", "xyz"[axis]));
        columns[axis] = static_cast<std::size_t>(found - fields.begin());
      }
      reader.recognise();
      continue;
    }
    if (fields.size() != n_columns) {
      reader.fail(fmt::format("found {} columns, expected {}", fields.size(), n_columns));
    }
    radiosity::Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = parse_number<double>(fields[columns[axis]]);
      if (!value || !std::isfinite(*value)) {
        reader.fail("expected a number, found " + reader.shown(fields[columns[axis]]));
      }
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    reader.recognise();
    points.push_back(point);
  }
  if (points.empty()) fail(path, "has no points");
  return points;
}

}  // namespace io
