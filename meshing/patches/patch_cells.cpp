#include "meshing/patches/patch_cells.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace meshing {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

namespace {

/// Moving a corner must leave this share of each patch's area, ...
constexpr double kLeastArea = 0.3;
/// ... and corners with this sine, or what they had.
constexpr double kLeastSine = 0.25;
/// Rounding of directions.
constexpr double kCellRounding = 1e-9;

std::pair<std::int32_t, std::int32_t> edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

PatchCells::PatchCells(const PatchMesh& mesh, Index n_fixed, std::span<const std::int32_t> patches)
    : mesh_(mesh),
      vertices_(mesh.vertices),
      is_locked_(mesh.vertices.size(), false),
      cells_at_(mesh.vertices.size()),
      cells_of_(mesh.size()),
      rows_of_(mesh.size()) {
  std::fill(is_locked_.begin(), is_locked_.begin() + n_fixed, true);
  for (const std::int32_t patch : patches) {
    add_cell(whole(patch).loop, patch);
    enter(cells_of_[patch].back());
  }
}

void PatchCells::add_cell(Loop loop, std::int32_t patch) {
  const auto made = static_cast<std::int32_t>(cells_.size());
  std::vector<std::int32_t>& cells = cells_of_[patch];
  if (cells.size() % kRow == 0) rows_of_[patch].emplace_back();
  place_.push_back(static_cast<std::int32_t>(cells.size()));
  cells.push_back(made);
  boxes_.emplace_back();
  cells_.push_back({std::move(loop), patch});
  for (const std::int32_t v : cells_.back().loop) extend_boxes(made, at(v));
}

void PatchCells::extend_boxes(std::int32_t cell, const Vec3& point) {
  boxes_[cell].extend(point);
  rows_of_[cells_[cell].patch][place_[cell] / kRow].extend(point);
}

Cell PatchCells::whole(std::int32_t patch) const {
  const auto& corners = mesh_.corners[patch];
  return {Loop(corners.begin(), corners.begin() + mesh_.n_corners(patch)), patch};
}

double PatchCells::shortest_edge(std::int32_t vertex) const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::int32_t cell : cells_at_[vertex]) {
    const Loop& loop = cells_[cell].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::int32_t next = loop[(k + 1) % loop.size()];
      if (loop[k] != vertex && next != vertex) continue;
      shortest = std::min(shortest, (at(loop[k]) - at(next)).norm());
    }
  }
  return shortest;
}

/// Whether an edge lies between two patches of one plane and polygon.
bool PatchCells::is_inside_polygon(const Edge& edge) const {
  const std::vector<std::int32_t>& cells = cells_on_.at(edge);
  if (cells.size() != 2) return false;
  const std::int32_t a = cells_[cells[0]].patch;
  const std::int32_t b = cells_[cells[1]].patch;
  return mesh_.polygon[a] == mesh_.polygon[b] &&
         mesh_.normal[a].cross(mesh_.normal[b]).norm() <= kCellRounding;
}

/// A corner within a polygon may go anywhere, one on an outline along it.
bool PatchCells::may_move(std::int32_t vertex, const Vec3& direction) const {
  if (is_locked_[vertex]) return false;
  for (const std::int32_t cell : cells_at_[vertex]) {
    const Loop& loop = cells_[cell].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::int32_t next = loop[(k + 1) % loop.size()];
      if (loop[k] != vertex && next != vertex) continue;
      if (is_inside_polygon(edge_of(loop[k], next))) continue;
      const Vec3 along = at(next) - at(loop[k]);
      if (along.cross(direction).norm() > kCellRounding * along.norm() * direction.norm())
        return false;
    }
  }
  return true;
}

double PatchCells::area_in(const Loop& loop, const Vec3& normal) const {
  double area = 0;
  for (std::size_t k = 2; k < loop.size(); ++k) {
    area += normal.dot((at(loop[k - 1]) - at(loop[0])).cross(at(loop[k]) - at(loop[0])));
  }
  return area / 2;
}

std::vector<double> PatchCells::sines_in(const Loop& loop, const Vec3& normal) const {
  std::vector<double> sines;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 before = at(loop[k]) - at(loop[(k + loop.size() - 1) % loop.size()]);
    const Vec3 after = at(loop[(k + 1) % loop.size()]) - at(loop[k]);
    sines.push_back(normal.dot(before.cross(after)) / (before.norm() * after.norm()));
  }
  return sines;
}

bool PatchCells::move(std::int32_t vertex, const Vec3& to) {
  if (!may_move(vertex, to - at(vertex))) return false;
  const Vec3 from = at(vertex);
  for (const std::int32_t cell : cells_at_[vertex]) {
    const Loop& loop = cells_[cell].loop;
    const Vec3& normal = mesh_.normal[cells_[cell].patch];
    const double area_before = area_in(loop, normal);
    const std::vector<double> before = sines_in(loop, normal);
    vertices_[vertex] = to;
    const std::vector<double> after = sines_in(loop, normal);
    bool is_good = area_in(loop, normal) >= kLeastArea * area_before;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      is_good = is_good && after[k] >= std::min(kLeastSine, before[k] - kCellRounding);
    }
    vertices_[vertex] = from;
    if (!is_good) return false;
  }
  vertices_[vertex] = to;
  is_locked_[vertex] = true;
  for (const std::int32_t cell : cells_at_[vertex]) extend_boxes(cell, to);
  return true;
}

void PatchCells::split_edge(std::int32_t a, std::int32_t b, const Vec3& point) {
  const auto made = static_cast<std::int32_t>(vertices_.size());
  vertices_.push_back(point);
  is_locked_.push_back(true);
  const std::vector<std::int32_t> cells = cells_on_.at(edge_of(a, b));
  cells_on_.erase(edge_of(a, b));
  for (const std::int32_t cell : cells) {
    Loop& loop = cells_[cell].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (edge_of(loop[k], loop[(k + 1) % loop.size()]) != edge_of(a, b)) continue;
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(k) + 1, made);
      break;
    }
    extend_boxes(cell, point);
  }
  cells_at_.push_back(cells);
  cells_on_[edge_of(a, made)] = cells;
  cells_on_[edge_of(made, b)] = cells;
}

void PatchCells::enter(std::int32_t cell) {
  const Loop& loop = cells_[cell].loop;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    cells_at_[loop[k]].push_back(cell);
    cells_on_[edge_of(loop[k], loop[(k + 1) % loop.size()])].push_back(cell);
  }
}

void PatchCells::take_out(std::int32_t cell) {
  const Loop& loop = cells_[cell].loop;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    std::erase(cells_at_[loop[k]], cell);
    std::erase(cells_on_[edge_of(loop[k], loop[(k + 1) % loop.size()])], cell);
  }
}

void PatchCells::split_cell(std::int32_t cell, std::size_t from, std::size_t to) {
  take_out(cell);
  const Loop whole = cells_[cell].loop;
  const auto first = whole.begin() + static_cast<std::ptrdiff_t>(from);
  const auto last = whole.begin() + static_cast<std::ptrdiff_t>(to);
  Loop rest(whole.begin(), first + 1);
  rest.insert(rest.end(), last, whole.end());
  cells_[cell].loop = std::move(rest);
  boxes_[cell].setEmpty();
  for (const std::int32_t v : cells_[cell].loop) boxes_[cell].extend(at(v));
  const std::int32_t patch = cells_[cell].patch;
  const auto made = static_cast<std::int32_t>(cells_.size());
  add_cell(Loop(first, last + 1), patch);
  enter(cell);
  enter(made);
}

}  // namespace meshing
