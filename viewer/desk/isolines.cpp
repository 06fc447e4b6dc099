#include "viewer/desk/isolines.h"

#include <algorithm>
#include <optional>

namespace viewer {
namespace {

using radiosity::Vec3;
using Triangle = std::array<std::int32_t, 3>;

constexpr double kEnd = 0.005;  // of the scale, that is taken for its very end
constexpr double kBetweenLevels = 0.2;
constexpr io::Rgb kDarkLine = {25, 25, 25};
constexpr io::Rgb kLightLine = {230, 230, 230};

/// Where a level crosses a triangle; empty if it does not.
std::optional<std::array<Vec3, 2>> crossing(const BlendedTriangles& field, const Triangle& triangle,
                                            double level) {
  std::array<Vec3, 2> ends;
  std::size_t n = 0;
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(triangle[k]);
    const auto b = static_cast<std::size_t>(triangle[(k + 1) % 3]);
    const double from = field.positions[a];
    const double to = field.positions[b];
    if (from < 0 || to < 0) return std::nullopt;
    if ((from < level) == (to < level)) continue;
    const double share = (level - from) / (to - from);
    ends[n++] = field.points[a] + share * (field.points[b] - field.points[a]);
  }
  if (n != 2) return std::nullopt;
  return ends;
}

/// Whether a number may stand there.
bool is_free(const std::vector<IsoNumber>& numbers, double value, const Vec3& place,
             double spacing) {
  return std::none_of(numbers.begin(), numbers.end(), [&](const IsoNumber& other) {
    const double wanted = other.value == value ? spacing : kBetweenLevels * spacing;
    return (other.place - place).squaredNorm() < wanted * wanted;
  });
}

}  // namespace

std::vector<IsoLevel> iso_levels(const Legend& legend) {
  std::vector<IsoLevel> levels;
  for (const double tick : legend.ticks) {
    const double position = io::position_on(legend.scale, tick);
    if (position > kEnd && position < 1 - kEnd) levels.push_back({tick, position});
  }
  return levels;
}

io::Rgb isoline_color(double position, io::ColorMap map) {
  const io::Rgb under = io::map_color(position, map);
  const double brightness = 0.3 * under[0] + 0.6 * under[1] + 0.1 * under[2];
  return brightness > 110 ? kDarkLine : kLightLine;
}

Isolines make_isolines(const BlendedTriangles& field, std::span<const IsoLevel> levels,
                       io::ColorMap map, const HiddenSurfaces& hidden, double spacing) {
  Isolines result;
  for (const IsoLevel& level : levels) {
    const io::Rgb color = isoline_color(level.position, map);
    for (std::size_t t = 0; t < field.triangles.size(); ++t) {
      if (hidden.contains(field.surfaces[t])) continue;
      const Triangle& triangle = field.triangles[t];
      const auto ends = crossing(field, triangle, level.position);
      if (!ends) continue;
      const Vec3& corner = field.points[triangle[0]];
      const Vec3 across =
          (field.points[triangle[1]] - corner).cross(field.points[triangle[2]] - corner);
      const Vec3 normal = across.normalized();
      result.lines.push_back({.ends = *ends, .normals = {normal, normal}, .color = color});
      const Vec3 middle = 0.5 * ((*ends)[0] + (*ends)[1]);
      if (is_free(result.numbers, level.value, middle, spacing)) {
        result.numbers.push_back({level.value, middle});
      }
    }
  }
  return result;
}

}  // namespace viewer
