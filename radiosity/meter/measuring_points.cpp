#include "radiosity/meter/measuring_points.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/picture/gather_interpolation.h"
#include "radiosity/polygon/convex_hull.h"

namespace radiosity {
namespace {

/// Cosine of the angle by which patches of a flat surface may differ, and how far they may be off
/// its plane, of its size.
constexpr double kFlatCosine = 0.999;
constexpr double kFlatShare = 1e-3;
constexpr double kCellShare = 1e-9;  // by which a cell may be too large for rounding

constexpr double kWidestBorder = 0.5;  // m
constexpr double kBorderShare = 0.15;

[[noreturn]] void fail(const GridPlan& plan, const std::string& message) {
  throw SceneError("grid \"" + plan.name + "\": " + message);
}

/// A rectangle with its sides, m.
struct Field {
  Vec3 corner;
  std::array<Vec3, 2> sides;
};

std::vector<Index> patches_of(const GridPlan& plan, const PatchMesh& mesh) {
  const auto name = std::find(mesh.surface_names.begin(), mesh.surface_names.end(), plan.surface);
  if (name == mesh.surface_names.end()) fail(plan, "no surface \"" + plan.surface + "\"");
  const auto surface = static_cast<std::int32_t>(name - mesh.surface_names.begin());
  std::vector<Index> patches;
  for (Index i = 0; i < mesh.size(); ++i) {
    const bool is_back = mesh.twin[i] >= 0 && mesh.twin[i] < i;
    if (mesh.surface[i] == surface && !is_back) patches.push_back(i);
  }
  if (patches.empty()) fail(plan, "surface \"" + plan.surface + "\" has no patches");
  return patches;
}

Vec3 common_normal(const GridPlan& plan, const PatchMesh& mesh, const std::vector<Index>& patches) {
  Vec3 sum = Vec3::Zero();
  Box3 box;
  for (const Index i : patches) {
    sum += mesh.area[i] * mesh.normal[i];
    for (int k = 0; k < mesh.n_corners(i); ++k) box.extend(mesh.corner(i, k));
  }
  const Vec3 normal = sum.stableNormalized();
  const double thickness = kFlatShare * box.diagonal().norm();
  const Vec3& start = mesh.centroid[patches.front()];
  for (const Index i : patches) {
    if (mesh.normal[i].dot(normal) > kFlatCosine &&
        std::abs(normal.dot(mesh.centroid[i] - start)) <= thickness) {
      continue;
    }
    fail(plan, "surface \"" + plan.surface + "\" is not flat; a rectangle needs no surface");
  }
  return normal;
}

/// The smallest rectangle around the patches, whose first side runs along x as far as may be, and
/// whose normal is theirs.
Field field_around(const PatchMesh& mesh, const std::vector<Index>& patches, const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  const Vec3& origin = mesh.centroid[patches.front()];
  std::vector<Vec3> corners;
  std::vector<Point2> places;
  for (const Index i : patches) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      corners.push_back(mesh.corner(i, k));
      places.emplace_back(u.dot(corners.back() - origin), v.dot(corners.back() - origin));
    }
  }
  std::vector<Vec3> outline;
  for (const std::int32_t k : convex_hull(places, kCellShare)) {
    // In the plane through the first patch, which the others may leave by a little.
    outline.emplace_back(origin + places[k].x() * u + places[k].y() * v);
  }
  const Rectangle rectangle = bounding_rectangle(outline, normal);
  std::array<Vec3, 4> ways = {rectangle.half_u, rectangle.half_v, -rectangle.half_u,
                              -rectangle.half_v};
  const auto first = std::max_element(ways.begin(), ways.end(), [](const Vec3& a, const Vec3& b) {
    return a.normalized().x() < b.normalized().x() - kCellShare;
  });
  const Vec3 half_side = *first;
  const Vec3 other = normal.cross(half_side.normalized());
  const double other_length = std::abs(other.dot(rectangle.half_u + rectangle.half_v));
  return {rectangle.center - half_side - other_length * other,
          {2 * half_side, 2 * other_length * other}};
}

/// The rectangle less its border, in equal cells.
PointGrid divided(const GridPlan& plan, const Field& field, double border, double& spacing) {
  std::array<double, 2> lengths = {field.sides[0].norm(), field.sides[1].norm()};
  const std::array<Vec3, 2> ways = {field.sides[0] / lengths[0], field.sides[1] / lengths[1]};
  const auto text = [](double length) { return std::to_string(length).substr(0, 6) + " m"; };
  for (double& length : lengths) {
    if (!(length > 2 * border)) {
      fail(plan, "a border of " + text(border) + " leaves nothing of " + text(length));
    }
  }
  const Vec3 corner = field.corner + border * (ways[0] + ways[1]);
  for (double& length : lengths) length -= 2 * border;
  if (!(spacing > 0)) spacing = largest_spacing(lengths[0], lengths[1]);
  const auto n_cells = [&](double length) {
    return std::max(1.0, std::ceil(length / spacing * (1 - kCellShare)));
  };
  const double n_columns = n_cells(lengths[0]);
  const double n_rows = n_cells(lengths[1]);
  if (!(n_columns * n_rows <= static_cast<double>(kMostGridPoints))) {
    fail(plan, "points " + text(spacing) + " apart would be more than " +
                   std::to_string(kMostGridPoints));
  }
  return {.corner = corner,
          .column = lengths[0] / n_columns * ways[0],
          .row = lengths[1] / n_rows * ways[1],
          .n_columns = static_cast<Index>(n_columns),
          .n_rows = static_cast<Index>(n_rows)};
}

/// Whether a patch of the surface lies behind the point.
bool is_above(const PatchMesh& mesh, const std::vector<Index>& patches, const Vec3& normal,
              const Vec3& point, double margin) {
  return std::any_of(patches.begin(), patches.end(), [&](Index i) {
    const int n = mesh.n_corners(i);
    for (int k = 0; k < n; ++k) {
      const Vec3& a = mesh.corner(i, k);
      const Vec3 edge = mesh.corner(i, (k + 1) % n) - a;
      if (normal.cross(edge).dot(point - a) < -margin * edge.norm()) return false;
    }
    return true;
  });
}

}  // namespace

double standard_border(double side, double other_side) {
  return std::min(kWidestBorder, kBorderShare * std::min(side, other_side));
}

MeasuringPoints make_measuring_points(const GridPlan& plan, const PatchMesh& mesh) {
  MeasuringPoints result;
  if (plan.is_list()) {
    result.points = plan.points;
    result.normals = plan.normals;
    return result;
  }
  std::vector<Index> patches;
  Field field{plan.corner, plan.sides};
  Vec3 normal = plan.sides[0].cross(plan.sides[1]).stableNormalized();
  const bool has_surface = !plan.surface.empty();
  if (has_surface) {
    patches = patches_of(plan, mesh);
    normal = common_normal(plan, mesh, patches);
    field = field_around(mesh, patches, normal);
    field.corner += plan.offset * normal;
  }
  const double standard =
      has_surface ? standard_border(field.sides[0].norm(), field.sides[1].norm()) : 0;
  result.border = plan.border.value_or(standard);
  result.spacing = plan.spacing;
  result.grid = divided(plan, field, result.border, result.spacing);
  const double margin = kCellShare * (field.sides[0] + field.sides[1]).norm();
  for (Index k = 0; k < result.grid->size(); ++k) {
    result.points.push_back(result.grid->point(k));
    result.normals.push_back(normal);
    if (has_surface) {
      result.is_off.push_back(!is_above(mesh, patches, normal, result.points.back(), margin));
    }
  }
  return result;
}

}  // namespace radiosity
