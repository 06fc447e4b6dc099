#include "apps/validation/reference/cornell_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "radiosity/base/error.h"

namespace apps::validation {
namespace {

using radiosity::SceneError;

// Columns of the file.
constexpr std::size_t kSurface = 1;
constexpr std::size_t kCorners = 3;
constexpr std::size_t kArea = 15;
constexpr std::size_t kRadiosity = 22;
constexpr std::size_t kError = 25;
constexpr std::size_t kColumns = 32;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

/// Three numbers from column `first` on. Throws SceneError with what was found.
Eigen::Vector3d triple(const std::vector<std::string>& fields, std::size_t first) {
  Eigen::Vector3d values;
  for (int k = 0; k < 3; ++k) {
    const std::string& text = fields[first + k];
    char* end = nullptr;
    values[k] = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') {
      throw SceneError(fmt::format("found '{}', expected a number", text));
    }
  }
  return values;
}

ReferencePolygon read_row(const std::string& line) {
  const std::vector<std::string> fields = split(line);
  if (fields.size() != kColumns) {
    throw SceneError(fmt::format("found {} columns, expected {}", fields.size(), kColumns));
  }
  ReferencePolygon polygon{.surface = fields[kSurface]};
  for (std::size_t k = 0; k < 4; ++k) polygon.corners.push_back(triple(fields, kCorners + 3 * k));
  polygon.area = triple(fields, kArea)[0];
  polygon.radiosity = triple(fields, kRadiosity);
  polygon.standard_error = triple(fields, kError);
  return polygon;
}

bool are_neighbors(const ReferencePolygon& a, const ReferencePolygon& b) {
  const auto n_common = std::count_if(a.corners.begin(), a.corners.end(), [&](const auto& corner) {
    return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end();
  });
  return a.surface == b.surface && n_common == 2;
}

}  // namespace

std::vector<ReferencePolygon> read_cornell_reference(const std::filesystem::path& data) {
  const std::filesystem::path path = data / "cornell-box" / "reference-radiosity-8x8.csv";
  std::ifstream file(path);
  if (!file) throw SceneError(fmt::format("{}: the reference cannot be read", path.string()));
  std::vector<ReferencePolygon> polygons;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    // A comment and the names of the columns come first.
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line[0])) == 0) continue;
    try {
      polygons.push_back(read_row(line));
    } catch (const SceneError& error) {
      throw SceneError(fmt::format("{}:{}: {}", path.string(), number, error.what()));
    }
  }
  return polygons;
}

double surface_radiosity(const std::vector<ReferencePolygon>& reference,
                         const std::string& surface) {
  double power = 0;
  double area = 0;
  for (const ReferencePolygon& polygon : reference) {
    if (polygon.surface != surface) continue;
    power += polygon.area * polygon.radiosity.sum();
    area += polygon.area;
  }
  return power / area;
}

std::vector<std::size_t> defective_polygons(const std::vector<ReferencePolygon>& reference) {
  std::vector<std::size_t> defective;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const ReferencePolygon& polygon = reference[i];
    if (polygon.radiosity.maxCoeff() > 0) continue;
    const double bright = surface_radiosity(reference, polygon.surface) / 2;
    int n_neighbors = 0;
    int n_bright = 0;
    for (const ReferencePolygon& other : reference) {
      if (!are_neighbors(polygon, other)) continue;
      ++n_neighbors;
      n_bright += other.radiosity.sum() >= bright ? 1 : 0;
    }
    if (n_neighbors > 0 && n_bright == n_neighbors) defective.push_back(i);
  }
  return defective;
}

}  // namespace apps::validation
