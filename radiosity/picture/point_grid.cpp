#include "radiosity/picture/point_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

constexpr double kLevelCosine = 0.999;  // of what faces upwards
constexpr double kSameLevel = 1e-3;     // of the scene's size
constexpr double kCellRounding = 1e-9;  // of a cell

std::string length_text(double length) {
  std::string text = std::to_string(std::round(length * 1e4) / 1e4);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Equal cells of at most that size in a length.
double n_cells(double length, double spacing) {
  return std::max(1.0, std::ceil(length / spacing - kCellRounding));
}

}  // namespace

double largest_spacing(double side, double other_side) {
  const double longer = std::max(side, other_side);
  const double shorter = std::min(side, other_side);
  const double d = longer >= 2 * shorter ? shorter : longer;
  return std::min(10.0, 0.2 * std::pow(5.0, std::log10(d)));
}

Floor find_floor(const PatchMesh& mesh, const Vec3& up) {
  std::vector<Index> facing_up;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.normal[i].dot(up) > kLevelCosine) facing_up.push_back(i);
  }
  const Box3 box = bounds(mesh);
  if (facing_up.empty())
    return {.level = std::min(up.dot(box.min()), up.dot(box.max())), .box = box};
  const auto height = [&](Index i) { return up.dot(mesh.centroid[i]); };
  std::sort(facing_up.begin(), facing_up.end(), [&](Index a, Index b) {
    return height(a) != height(b) ? height(a) < height(b) : a < b;
  });
  struct Level {
    double area = 0;
    double moment = 0;
    Box3 box;
  };
  std::vector<Level> levels;
  const double gap = kSameLevel * box.diagonal().norm();
  for (std::size_t k = 0; k < facing_up.size(); ++k) {
    const Index i = facing_up[k];
    if (k == 0 || height(i) > height(facing_up[k - 1]) + gap) levels.emplace_back();
    Level& level = levels.back();
    level.area += mesh.area[i];
    level.moment += mesh.area[i] * height(i);
    for (int c = 0; c < mesh.n_corners(i); ++c) level.box.extend(mesh.corner(i, c));
  }
  const double most =
      std::max_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) {
        return a.area < b.area;
      })->area;
  const auto floor = std::find_if(levels.begin(), levels.end(),
                                  [&](const Level& level) { return level.area >= 0.5 * most; });
  return {.level = floor->moment / floor->area, .box = floor->box, .is_found = true};
}

PointGrid make_work_plane(const PatchMesh& mesh, const Vec3& up, const WorkPlaneOptions& options) {
  Index axis = 0;
  [[maybe_unused]] const double largest = up.cwiseAbs().maxCoeff(&axis);
  assert(up.squaredNorm() == largest * largest);
  const Floor floor = find_floor(mesh, up);
  const std::array<Index, 2> across = {(axis + 1) % 3, (axis + 2) % 3};
  std::array<double, 2> sides{};
  for (int k = 0; k < 2; ++k) sides[k] = floor.box.sizes()[across[k]] - 2 * options.border;
  if (!(sides[0] > 0 && sides[1] > 0)) {
    throw SceneError("a border of " + length_text(options.border) +
                     " m leaves nothing of a floor of " +
                     length_text(floor.box.sizes()[across[0]]) + " m x " +
                     length_text(floor.box.sizes()[across[1]]) + " m");
  }
  const double spacing =
      options.spacing > 0 ? options.spacing : 0.5 * largest_spacing(sides[0], sides[1]);
  const double n_columns = n_cells(sides[0], spacing);
  const double n_rows = n_cells(sides[1], spacing);
  if (!(n_columns * n_rows <= static_cast<double>(kMostGridPoints))) {
    throw SceneError("points " + length_text(spacing) + " m apart would be more than " +
                     std::to_string(kMostGridPoints));
  }
  PointGrid grid;
  grid.n_columns = static_cast<Index>(n_columns);
  grid.n_rows = static_cast<Index>(n_rows);
  grid.corner = (floor.level + options.height) * up;
  std::array<Vec3, 2> steps = {Vec3::Zero(), Vec3::Zero()};
  for (int k = 0; k < 2; ++k) {
    grid.corner[across[k]] = floor.box.min()[across[k]] + options.border;
    steps[k][across[k]] = sides[k];
  }
  grid.column = steps[0] / n_columns;
  grid.row = steps[1] / n_rows;
  if (up[axis] < 0) {  // else it would look downwards
    std::swap(grid.column, grid.row);
    std::swap(grid.n_columns, grid.n_rows);
  }
  return grid;
}

}  // namespace radiosity
