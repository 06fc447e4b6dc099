#include "io/result/given_heat_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/result/read_cell_values.h"

namespace io {
namespace {

using radiosity::GivenHeat;
using radiosity::Index;

constexpr std::array<std::string_view, 4> kTemperatures = {"temperature", "surface_temperature",
                                                           "T", "value"};
constexpr std::array<std::string_view, 2> kHeatFluxes = {"heat_flux", "value"};

std::span<const std::string_view> names_of(GivenHeat::Kind kind) {
  return kind == GivenHeat::Kind::temperature ? std::span<const std::string_view>(kTemperatures)
                                              : std::span<const std::string_view>(kHeatFluxes);
}

/// The fields of a line, which may stand in quotes with commas in them.
std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> result;
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t k = 0; k <= line.size(); ++k) {
    if (k < line.size() && line[k] == '"') is_quoted = !is_quoted;
    if (k < line.size() && (line[k] != ',' || is_quoted)) continue;
    result.push_back(trimmed(line.substr(begin, k - begin)));
    begin = k + 1;
  }
  return result;
}

/// Where the first of these names stands among the columns; their number if none does.
std::size_t column_of(const std::vector<std::string_view>& columns,
                      std::span<const std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  }
  return columns.size();
}

GivenHeat read_csv_heat(const std::filesystem::path& path, GivenHeat::Kind kind,
                        const radiosity::Progress& progress) {
  GivenHeat heat{.kind = kind, .of = GivenHeat::Of::patches, .values = {}, .source = path.string()};
  LineReader reader(path, progress);
  if (!reader.next_content()) fail(path, "has no column names");
  const std::string header(reader.line());
  const std::vector<std::string_view> columns = fields(header);
  constexpr std::array<std::string_view, 2> kNumbers = {"patch", "polygon"};
  const std::size_t number = column_of(columns, kNumbers);
  const std::size_t value = column_of(columns, names_of(kind));
  if (number == columns.size()) reader.fail("has no column patch or polygon");
  reader.recognise();
  if (value == columns.size()) {
    reader.fail(fmt::format("has no column of what is given, expected one of {}",
                            fmt::join(names_of(kind), ", ")));
  }
  if (columns[number] == "polygon") heat.of = GivenHeat::Of::polygons;
  while (reader.next_content()) {
    const std::vector<std::string_view> row = fields(reader.line());
    if (row.size() != columns.size()) {
      reader.fail(fmt::format("found {} columns, expected {}", row.size(), columns.size()));
    }
    const auto index = parse_number<std::int64_t>(row[number]);
    if (!index) {
      reader.fail(fmt::format("found {}, expected the number of a {}", reader.shown(row[number]),
                              columns[number]));
    }
    if (row[value].empty()) continue;
    const auto given = parse_number<double>(row[value]);
    if (!given || !std::isfinite(*given)) {
      reader.fail(fmt::format("expected a number, found {}", reader.shown(row[value])));
    }
    heat.values.emplace_back(static_cast<Index>(*index), *given);
  }
  if (heat.values.empty()) fail(path, "has no values");
  return heat;
}

GivenHeat read_cell_heat(const std::filesystem::path& path, GivenHeat::Kind kind) {
  if (radiosity_io_read_cell_values == nullptr) {
    fail(path, "this program was built without VTK, which such files need");
  }
  CellValues cells;
  radiosity_io_read_cell_values(path, names_of(kind), cells);
  if (cells.name.empty()) {
    fail(path, fmt::format("has no cell data of the name {}", fmt::join(names_of(kind), ", ")));
  }
  GivenHeat heat{.kind = kind, .of = GivenHeat::Of::cells, .values = {}, .source = path.string()};
  for (std::size_t k = 0; k < cells.values.size(); ++k) {
    heat.values.emplace_back(static_cast<Index>(k), cells.values[k]);
  }
  return heat;
}

}  // namespace

GivenHeat read_given_heat(const std::filesystem::path& path, GivenHeat::Kind kind,
                          const radiosity::Progress& progress) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".csv") return read_csv_heat(path, kind, progress);
  if (extension == ".vtp" || extension == ".vtu" || extension == ".vtk") {
    return read_cell_heat(path, kind);
  }
  fail(path, fmt::format("unknown extension \"{}\", expected .csv, .vtp, .vtu or .vtk", extension));
}

}  // namespace io
