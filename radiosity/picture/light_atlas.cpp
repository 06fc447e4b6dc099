#include "radiosity/picture/light_atlas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/polygon/convex_hull.h"

namespace radiosity {
namespace {

constexpr int kGutter = 1;  // texels
/// The least cosine between normals of patches that share a chart. A polygon that is not quite flat
/// is shortened by less than a millionth.
constexpr double kFlat = 1 - 1e-6;

/// The patches of each polygon and side.
std::vector<AtlasChart> find_charts(const PatchMesh& mesh) {
  std::vector<AtlasChart> charts;
  const auto n = static_cast<std::int32_t>(mesh.size());
  std::vector<std::int32_t> order(mesh.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return mesh.polygon[a] < mesh.polygon[b];
  });
  std::size_t first_of_polygon = 0;
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t patch = order[k];
    if (k > 0 && mesh.polygon[patch] != mesh.polygon[order[k - 1]])
      first_of_polygon = charts.size();
    auto chart = std::find_if(charts.begin() + static_cast<std::ptrdiff_t>(first_of_polygon),
                              charts.end(), [&](const AtlasChart& candidate) {
                                const auto first = candidate.patches.front();
                                return mesh.normal[first].dot(mesh.normal[patch]) > kFlat &&
                                       mesh.surface[first] == mesh.surface[patch];
                              });
    if (chart == charts.end()) chart = charts.insert(charts.end(), AtlasChart());
    chart->patches.push_back(patch);
  }
  return charts;
}

/// The box along a direction in the plane.
struct Box2 {
  Point2 direction = Point2::UnitX();
  Point2 low = Point2::Zero();
  Point2 extent = Point2::Zero();
};

Box2 box_along(const std::vector<Point2>& points, const Point2& direction) {
  Point2 low = Point2::Constant(std::numeric_limits<double>::infinity());
  Point2 high = -low;
  for (const Point2& point : points) {
    const Point2 turned(direction.dot(point), cross2(direction, point));
    low = low.cwiseMin(turned);
    high = high.cwiseMax(turned);
  }
  return {direction, low, high - low};
}

/// The smallest box around the points, which one of the edges of their hull lies on.
Box2 smallest_box(const std::vector<Point2>& points) {
  Box2 best = box_along(points, Point2::UnitX());
  const std::vector<std::int32_t> hull = convex_hull(points, 0);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Point2 edge = points[hull[(k + 1) % hull.size()]] - points[hull[k]];
    if (!(edge.norm() > 0)) continue;
    const Box2 box = box_along(points, edge.normalized());
    // A little must be gained, so that the first of equal ones stays whatever the rounding.
    if (box.extent.prod() < (1 - 1e-9) * best.extent.prod()) best = box;
  }
  return best;
}

/// Puts the chart's rectangle around its patches, the longer side across.
void place_in_plane(const PatchMesh& mesh, AtlasChart& chart) {
  const std::int32_t first = chart.patches.front();
  const Vec3 base = mesh.corner(first, 0);
  const Vec3 axis = mesh.normal[first].unitOrthogonal();
  const Vec3 other = mesh.normal[first].cross(axis);
  std::vector<Point2> points;
  for (const std::int32_t patch : chart.patches) {
    for (int k = 0; k < mesh.n_corners(patch); ++k) {
      const Vec3 offset = mesh.corner(patch, k) - base;
      points.emplace_back(offset.dot(axis), offset.dot(other));
    }
  }
  const Box2 box = smallest_box(points);
  chart.across = box.direction.x() * axis + box.direction.y() * other;
  chart.down = -box.direction.y() * axis + box.direction.x() * other;
  chart.origin = base + box.low.x() * chart.across + box.low.y() * chart.down;
  chart.extent = box.extent;
  if (chart.extent.x() >= chart.extent.y()) return;
  std::swap(chart.across, chart.down);
  std::swap(chart.extent.x(), chart.extent.y());
}

/// Texels that a length takes with its gutters: the first and last of the others have their middle
/// at its ends or beyond.
int n_texels(double length, double texel) {
  return static_cast<int>(std::ceil(length / texel * (1 - 1e-12))) + 1 + 2 * kGutter;
}

/// Places the charts, in falling order of height, in rows. Returns the height that they take;
/// nothing if it is above `size`.
std::optional<int> place_in_rows(std::vector<AtlasChart>& charts,
                                 const std::vector<std::size_t>& order, double texel, int size) {
  int x = 0;
  int y = 0;
  int row_height = 0;
  for (const std::size_t k : order) {
    AtlasChart& chart = charts[k];
    // So that nothing large becomes an int.
    if (!(chart.extent.x() / texel < size)) return std::nullopt;
    chart.width = n_texels(chart.extent.x(), texel);
    chart.height = n_texels(chart.extent.y(), texel);
    if (chart.width > size) return std::nullopt;
    if (x + chart.width > size) {
      y += std::exchange(row_height, 0);
      x = 0;
    }
    row_height = std::max(row_height, chart.height);
    if (y + row_height > size) return std::nullopt;
    chart.x = x;
    chart.y = y;
    x += chart.width;
  }
  return y + row_height;
}

/// Sets the texels' size to the smallest that fits, to a thousandth, and the charts' places.
void pack(LightAtlas& atlas, int size) {
  std::vector<AtlasChart>& charts = atlas.charts;
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return charts[a].extent.y() > charts[b].extent.y();
  });
  double longest = 0;
  for (const AtlasChart& chart : charts) longest = std::max(longest, chart.extent.x());
  // With texels as long as the longest chart all have their least size.
  double fits = longest;
  if (!place_in_rows(charts, order, fits, size)) {
    throw MeshError("a lightmap of " + std::to_string(size) + " x " + std::to_string(size) +
                    " texels has no room for " + std::to_string(charts.size()) + " polygons");
  }
  double fails = longest / size;
  while (fits > 1.001 * fails) {
    const double middle = std::sqrt(fits * fails);
    (place_in_rows(charts, order, middle, size) ? fits : fails) = middle;
  }
  atlas.texel = fits;
  atlas.width = size;
  atlas.height = *place_in_rows(charts, order, fits, size);
}

}  // namespace

Point2 LightAtlas::coordinates(const AtlasChart& of, const Vec3& at) const {
  const Vec3 offset = at - of.origin;
  return {of.x + kGutter + 0.5 + offset.dot(of.across) / texel,
          of.y + kGutter + 0.5 + offset.dot(of.down) / texel};
}

Vec3 LightAtlas::point(const AtlasChart& of, int column, int row) const {
  return of.origin + (column - of.x - kGutter) * texel * of.across +
         (row - of.y - kGutter) * texel * of.down;
}

LightAtlas make_light_atlas(const PatchMesh& mesh, int size) {
  LightAtlas atlas;
  atlas.charts = find_charts(mesh);
  atlas.chart.resize(mesh.size());
  for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
    place_in_plane(mesh, atlas.charts[k]);
    for (const std::int32_t patch : atlas.charts[k].patches) {
      atlas.chart[patch] = static_cast<std::int32_t>(k);
    }
  }
  pack(atlas, size);
  return atlas;
}

}  // namespace radiosity
