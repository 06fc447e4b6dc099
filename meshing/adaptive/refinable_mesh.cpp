#include "meshing/adaptive/refinable_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshing {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// A cut must leave pieces at least this wide, relative to the size of what is cut.
constexpr double kLeastWidth = 0.01;
/// Points of cuts this close to each other, relative to their edge, are one.
constexpr double kSamePoint = 1e-6;

using Corners = std::vector<std::int32_t>;

/// A convex polygon in triangles and quads: quads are taken off until four corners or fewer remain.
std::vector<Corners> in_patches(Corners polygon) {
  std::vector<Corners> result;
  while (polygon.size() > 4) {
    result.push_back({polygon[0], polygon[1], polygon[2], polygon[3]});
    polygon.erase(polygon.begin() + 1, polygon.begin() + 3);
  }
  result.push_back(std::move(polygon));
  return result;
}

Corners corners_of(const PatchMesh& mesh, Index i) {
  const auto& corners = mesh.corners[i];
  return {corners.begin(), corners.begin() + mesh.n_corners(i)};
}

}  // namespace

RefinableMesh::RefinableMesh(const PatchMesh& mesh) {
  mesh_.vertices = mesh.vertices;
  mesh_.surface_names = mesh.surface_names;
  mesh_.surface_two_sided = mesh.surface_two_sided;
  mesh_.precision = mesh.precision;
  mesh_.images = mesh.images;
  mesh_.polygon_corners = mesh.polygon_corners;
  mesh_.first_polygon_corner = mesh.first_polygon_corner;
  const std::vector<std::vector<Segment>> lines = contact_lines(mesh);
  for (Index i = 0; i < mesh.size(); ++i) {
    const std::int32_t twin = mesh.twin[i];
    if (twin >= 0 && twin < i) continue;  // made with its twin
    std::vector<Segment> segments = lines[i];
    if (twin >= 0) segments.insert(segments.end(), lines[twin].begin(), lines[twin].end());
    cut_patch(mesh, i, segments);
  }
  build();
}

std::int32_t RefinableMesh::add_cell(Cell cell) {
  cells_.push_back(std::move(cell));
  const auto index = static_cast<std::int32_t>(cells_.size()) - 1;
  register_edges(index, 1);
  return index;
}

/// Enters a patch at its edges (change 1) or takes it out (-1).
void RefinableMesh::register_edges(std::int32_t cell, int change) {
  const Corners& corners = cells_[cell].corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    auto& there = patches_at_[edge(corners[k], corners[(k + 1) % corners.size()])];
    if (change > 0) {
      there.push_back(cell);
    } else {
      std::erase(there, cell);
    }
  }
}

/// The vertex at a point of an edge; the same for all who cut it there, in whatever order.
std::int32_t RefinableMesh::cut_point(const Edge& cut, const Vec3& point) {
  Edge uncut = cut;
  for (auto whole = whole_edge_.find(uncut); whole != whole_edge_.end();
       whole = whole_edge_.find(uncut)) {
    uncut = whole->second;
  }
  const double length = (mesh_.vertices[uncut.first] - mesh_.vertices[uncut.second]).norm();
  std::vector<std::int32_t>& points = points_on_[uncut];
  const auto known = std::find_if(points.begin(), points.end(), [&](std::int32_t vertex) {
    return (mesh_.vertices[vertex] - point).norm() <= kSamePoint * length;
  });
  const auto vertex =
      known != points.end() ? *known : static_cast<std::int32_t>(mesh_.vertices.size());
  if (known == points.end()) {
    mesh_.vertices.push_back(point);
    points.push_back(vertex);
  }
  whole_edge_[edge(cut.first, vertex)] = cut;
  whole_edge_[edge(vertex, cut.second)] = cut;
  return vertex;
}

/// The pieces of a convex polygon left and right of the line of a segment; the polygon itself if
/// the segment does not pass through it.
std::vector<Corners> RefinableMesh::cut(const Corners& polygon, const Segment& segment,
                                        const Vec3& normal) {
  const Vec3 along = (segment[1] - segment[0]).normalized();
  const Vec3 across = normal.cross(along);
  std::vector<double> side;
  double size = 0;
  for (const std::int32_t v : polygon) {
    side.push_back(across.dot(mesh_.vertices[v] - segment[0]));
    size = std::max(size, (mesh_.vertices[v] - mesh_.vertices[polygon[0]]).norm());
  }
  const double least = kLeastWidth * size;
  const auto [lowest, highest] = std::minmax_element(side.begin(), side.end());
  if (*lowest > -least || *highest < least) return {polygon};

  // Where the line is inside the polygon, measured along it.
  const std::size_t n = polygon.size();
  double enters = std::numeric_limits<double>::infinity();
  double leaves = -enters;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    if ((side[k] > 0) == (side[next] > 0)) continue;
    const double t = side[k] / (side[k] - side[next]);
    const Vec3 point = mesh_.vertices[polygon[k]] +
                       t * (mesh_.vertices[polygon[next]] - mesh_.vertices[polygon[k]]);
    enters = std::min(enters, along.dot(point - segment[0]));
    leaves = std::max(leaves, along.dot(point - segment[0]));
  }
  const double length = (segment[1] - segment[0]).norm();
  if (std::min(leaves, length) - std::max(enters, 0.0) < least) return {polygon};

  Corners left;
  Corners right;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const double snap = kSamePoint * size;
    if (side[k] >= -snap) left.push_back(polygon[k]);
    if (side[k] <= snap) right.push_back(polygon[k]);
    if (std::abs(side[k]) <= snap || std::abs(side[next]) <= snap) continue;
    if ((side[k] > 0) == (side[next] > 0)) continue;
    const double t = side[k] / (side[k] - side[next]);
    const Vec3 point = mesh_.vertices[polygon[k]] +
                       t * (mesh_.vertices[polygon[next]] - mesh_.vertices[polygon[k]]);
    const std::int32_t vertex = cut_point(edge(polygon[k], polygon[next]), point);
    left.push_back(vertex);
    right.push_back(vertex);
  }
  return {left, right};
}

void RefinableMesh::cut_patch(const PatchMesh& mesh, Index i, std::span<const Segment> segments) {
  std::vector<Corners> pieces = {corners_of(mesh, i)};
  for (const Segment& segment : segments) {
    std::vector<Corners> smaller;
    for (const Corners& piece : pieces) {
      for (Corners& part : cut(piece, segment, mesh.normal[i])) smaller.push_back(std::move(part));
    }
    pieces = std::move(smaller);
  }
  for (const Corners& piece : pieces) {
    for (const Corners& corners : in_patches(piece)) {
      const std::int32_t cell = add_cell({corners, mesh.surface[i], mesh.polygon[i], -1, -1, {}});
      roots_.push_back(cell);
      if (mesh.twin[i] < 0) continue;
      cells_[cell].twin = cell + 1;
      roots_.push_back(add_cell({Corners(corners.rbegin(), corners.rend()),
                                 mesh.surface[i],
                                 mesh.polygon[i],
                                 cell,
                                 -1,
                                 {}}));
    }
  }
}

std::int32_t RefinableMesh::middle(std::int32_t a, std::int32_t b) {
  const Edge whole = edge(a, b);
  const auto next = static_cast<std::int32_t>(mesh_.vertices.size());
  const auto [place, is_new] = middles_.try_emplace(whole, next);
  if (is_new) {
    mesh_.vertices.emplace_back((mesh_.vertices[a] + mesh_.vertices[b]) / 2);
    whole_edge_[edge(a, next)] = whole;
    whole_edge_[edge(next, b)] = whole;
  }
  return place->second;
}

/// Divides a patch, and before it neighbours of twice its size and more.
void RefinableMesh::divide(std::int32_t cell) {
  if (!cells_[cell].parts.empty()) return;
  const Corners corners = cells_[cell].corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto whole = whole_edge_.find(edge(corners[k], corners[(k + 1) % corners.size()]));
    if (whole == whole_edge_.end()) continue;
    const Corners larger = patches_at_[whole->second];
    for (const std::int32_t neighbor : larger) divide(neighbor);
  }
  if (!cells_[cell].parts.empty()) return;  // as the twin of one of these
  const std::int32_t twin = cells_[cell].twin;
  divide_one(cell);
  if (twin < 0) return;
  divide_one(twin);
  // The twin's parts, in the same places.
  for (const std::int32_t part : cells_[cell].parts) {
    Corners sorted = cells_[part].corners;
    std::sort(sorted.begin(), sorted.end());
    for (const std::int32_t other : cells_[twin].parts) {
      Corners candidate = cells_[other].corners;
      std::sort(candidate.begin(), candidate.end());
      if (candidate != sorted) continue;
      cells_[part].twin = other;
      cells_[other].twin = part;
    }
  }
}

void RefinableMesh::divide_one(std::int32_t cell) {
  register_edges(cell, -1);
  const Cell whole = cells_[cell];
  const Corners& c = whole.corners;
  std::vector<Corners> parts;
  if (c.size() == 4) {
    const Corners m = {middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[3]),
                       middle(c[3], c[0])};
    // Between opposite middles, which twins share; not on an edge of any other patch.
    const std::int32_t center = middle(std::min(m[0], m[2]), std::max(m[0], m[2]));
    parts = {{c[0], m[0], center, m[3]},
             {m[0], c[1], m[1], center},
             {center, m[1], c[2], m[2]},
             {m[3], center, m[2], c[3]}};
  } else {
    const Corners m = {middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[0])};
    parts = {{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[0], m[1], m[2]}};
  }
  const std::int32_t family = n_families_++;
  for (const Corners& part : parts) {
    const std::int32_t made = add_cell({part, whole.surface, whole.polygon, -1, family, {}});
    cells_[cell].parts.push_back(made);
  }
}

std::vector<std::int32_t> RefinableMesh::refine(std::span<const Index> patches) {
  const std::vector<std::int32_t> before = patch_of_cell_;
  for (const Index patch : patches) divide(cell_of_patch_[patch]);
  build();
  std::vector<std::int32_t> number_before;
  for (const std::int32_t cell : cell_of_patch_) {
    number_before.push_back(cell < static_cast<std::int32_t>(before.size()) ? before[cell] : -1);
  }
  return number_before;
}

/// Makes the mesh of the cells that are patches.
void RefinableMesh::build() {
  PatchMesh mesh;
  mesh.vertices = std::move(mesh_.vertices);
  mesh.surface_names = std::move(mesh_.surface_names);
  mesh.surface_two_sided = std::move(mesh_.surface_two_sided);
  mesh.precision = mesh_.precision;
  mesh.images = std::move(mesh_.images);
  mesh.polygon_corners = std::move(mesh_.polygon_corners);
  mesh.first_polygon_corner = std::move(mesh_.first_polygon_corner);
  mesh_ = std::move(mesh);
  cell_of_patch_.clear();
  patch_of_cell_.assign(cells_.size(), -1);
  for (const std::int32_t root : roots_) append(root);
  for (Index i = 0; i < mesh_.size(); ++i) {
    const std::int32_t twin = cells_[cell_of_patch_[i]].twin;
    if (twin >= 0) mesh_.twin[i] = patch_of_cell_[twin];
  }
}

void RefinableMesh::append(std::int32_t index) {
  const Cell& cell = cells_[index];
  if (!cell.parts.empty()) {
    for (const std::int32_t part : cell.parts) append(part);
    return;
  }
  patch_of_cell_[index] = static_cast<std::int32_t>(mesh_.size());
  cell_of_patch_.push_back(index);
  mesh_.add_patch({cell.corners[0], cell.corners[1], cell.corners[2],
                   cell.corners.size() == 4 ? cell.corners[3] : -1},
                  cell.surface, cell.polygon);
  mesh_.family.back() = cell.family;
}

}  // namespace meshing
