#include "io/scene/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/base/line_reader.h"
#include "radiosity/picture/point_grid.h"

namespace io {
namespace {

using radiosity::Vec3;

constexpr const char* kColumns = "expected 3 (x,y,z) or 6 (x,y,z,nx,ny,nz)";

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Whether the line names columns; throws if it names others.
bool is_header(LineReader& lines, const std::vector<std::string_view>& fields) {
  if (fields.front() != "x") return false;
  constexpr auto kNames = std::to_array<std::string_view>({"x", "y", "z", "nx", "ny", "nz"});
  const bool is_known = (fields.size() == 3 || fields.size() == 6) &&
                        std::equal(fields.begin(), fields.end(), kNames.begin());
  if (!is_known) lines.fail("the columns are not x,y,z or x,y,z,nx,ny,nz");
  lines.recognise();
  return true;
}

}  // namespace

void add_points(const std::filesystem::path& path, double unit, radiosity::GridPlan& plan) {
  const radiosity::Progress progress;
  LineReader lines(path, progress);
  bool is_first = true;
  std::size_t n_columns = 0;
  while (lines.next_content()) {
    const auto fields = fields_of(lines.line());
    if (std::exchange(is_first, false) && is_header(lines, fields)) continue;
    if (fields.size() != 3 && fields.size() != 6) {
      lines.fail(fmt::format("found {} columns, {}", fields.size(), kColumns));
    }
    if (n_columns != 0 && fields.size() != n_columns) {
      lines.fail(fmt::format("found {} columns, {} before", fields.size(), n_columns));
    }
    n_columns = fields.size();
    std::array<double, 6> numbers{};
    for (std::size_t k = 0; k < n_columns; ++k) {
      const auto number = parse_number<double>(fields[k]);
      if (!number || !std::isfinite(*number)) {
        lines.fail(fmt::format("expected a number, found {}", lines.shown(fields[k])));
      }
      numbers[k] = *number;
    }
    lines.recognise();
    const Vec3 normal(numbers[3], numbers[4], numbers[5]);
    if (n_columns == 6 && !(normal.stableNorm() > 0)) lines.fail("the normal is 0");
    plan.points.emplace_back(unit * numbers[0], unit * numbers[1], unit * numbers[2]);
    plan.normals.push_back(n_columns == 6 ? Vec3(normal.stableNormalized())
                                          : plan.up.value_or(Vec3::UnitZ()));
    if (plan.points.size() > static_cast<std::size_t>(radiosity::kMostGridPoints)) {
      lines.fail(fmt::format("there are more than {} points", radiosity::kMostGridPoints));
    }
  }
  if (plan.points.empty()) fail(path, "has no points");
}

}  // namespace io
