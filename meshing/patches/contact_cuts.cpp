#include "meshing/patches/contact_cuts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "meshing/base/triangulate.h"
#include "meshing/patches/halfedge.h"
#include "radiosity/base/box_tree.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::BoxTree;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// A corner is moved by no more than this share of the shortest edge that it has there.
constexpr double kLongestMove = 0.3;
/// Moving a corner must leave this share of each patch's area, ...
constexpr double kLeastArea = 0.3;
/// ... and corners with this sine, or what they had.
constexpr double kLeastSine = 0.25;
/// Two triangles become a quad if its corners have this sine.
constexpr double kQuadSine = 0.4;
/// What is narrower than this share of its length is not cut off.
constexpr double kLeastWidth = 1e-5;
/// Rounding of directions.
constexpr double kRounding = 1e-9;

using Loop = std::vector<std::int32_t>;
using Edge = std::pair<std::int32_t, std::int32_t>;  // vertices, the lower one first

struct EdgeHash {
  std::size_t operator()(const Edge& edge) const {
    return std::hash<std::int64_t>{}(static_cast<std::int64_t>(edge.first) << 32 | edge.second);
  }
};

Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// A convex part of a patch: the vertices around it, those on its straight edges included.
struct Cell {
  Loop loop;
  std::int32_t patch;
};

class ContactCutter {
 public:
  ContactCutter(const PatchMesh& mesh, std::span<const std::vector<Segment>> lines, Index n_fixed,
                const radiosity::Progress& progress)
      : mesh_(mesh),
        lines_(lines),
        progress_(progress),
        vertices_(mesh.vertices),
        is_locked_(mesh.vertices.size(), false),
        cells_at_(mesh.vertices.size()),
        cells_of_(mesh.size()),
        tolerance_(radiosity::plane_thickness(mesh)) {
    std::fill(is_locked_.begin(), is_locked_.begin() + n_fixed, true);
  }

  PatchMesh run();

 private:
  void make_cells();
  void cut_polygon(std::int32_t polygon);
  void catch_point(const Vec3& point, std::int32_t polygon);
  void cut_cell(std::int32_t cell, const Segment& segment);

  [[nodiscard]] std::vector<std::int32_t> patches_near(const Box3& box, std::int32_t polygon) const;
  [[nodiscard]] double shortest_edge(std::int32_t vertex) const;
  [[nodiscard]] bool may_move(std::int32_t vertex, const Vec3& direction) const;
  [[nodiscard]] bool is_inside_polygon(const Edge& edge) const;
  bool move(std::int32_t vertex, const Vec3& to);
  void split_edge(std::int32_t a, std::int32_t b, const Vec3& point);
  void split_cell(std::int32_t cell, std::size_t from, std::size_t to);
  void enter(std::int32_t cell);
  void take_out(std::int32_t cell);

  [[nodiscard]] std::vector<Loop> patches_of(const Cell& cell) const;
  void append(PatchMesh& result, const Loop& loop, std::int32_t patch) const;

  [[nodiscard]] const Vec3& at(std::int32_t vertex) const { return vertices_[vertex]; }
  [[nodiscard]] double area_in(const Loop& loop, const Vec3& normal) const;
  [[nodiscard]] std::vector<double> sines_in(const Loop& loop, const Vec3& normal) const;

  const PatchMesh& mesh_;
  std::span<const std::vector<Segment>> lines_;
  const radiosity::Progress& progress_;
  std::vector<Vec3> vertices_;
  std::vector<bool> is_locked_;  // corners of the input, and what lies on a contact line
  std::vector<Cell> cells_;
  std::vector<std::vector<std::int32_t>> cells_at_;  // per vertex
  std::vector<std::vector<std::int32_t>> cells_of_;  // per patch; of the front of two
  std::unordered_map<Edge, std::vector<std::int32_t>, EdgeHash> cells_on_;
  std::optional<BoxTree> tree_;           // of patches that may be cut
  std::vector<std::int32_t> tree_patch_;  // what its boxes belong to
  double tolerance_;
};

PatchMesh ContactCutter::run() {
  make_cells();
  for (std::size_t p = 0; p < lines_.size(); ++p) {
    if (lines_[p].empty()) continue;
    progress_.check();
    cut_polygon(static_cast<std::int32_t>(p));
  }
  PatchMesh result;
  result.vertices = vertices_;
  result.surface_names = mesh_.surface_names;
  result.surface_two_sided = mesh_.surface_two_sided;
  result.precision = mesh_.precision;
  result.polygon_corners = mesh_.polygon_corners;
  result.first_polygon_corner = mesh_.first_polygon_corner;
  for (std::size_t i = 0; i < cells_of_.size(); ++i) {
    for (const std::int32_t cell : cells_of_[i]) {
      for (const Loop& loop : patches_of(cells_[cell])) {
        append(result, loop, static_cast<std::int32_t>(i));
      }
    }
  }
  return result;
}

void ContactCutter::make_cells() {
  std::vector<Box3> boxes;
  for (Index i = 0; i < mesh_.size(); ++i) {
    if (mesh_.twin[i] >= 0 && mesh_.twin[i] < i) continue;
    const auto& corners = mesh_.corners[i];
    const auto patch = static_cast<std::int32_t>(i);
    cells_of_[i].push_back(static_cast<std::int32_t>(cells_.size()));
    cells_.push_back({Loop(corners.begin(), corners.begin() + mesh_.n_corners(i)), patch});
    enter(cells_of_[i].back());
    if (lines_[mesh_.polygon[i]].empty()) continue;
    const Box3 box = patch_box(mesh_, i);
    // Corners may move.
    boxes.push_back(radiosity::grown(box, tolerance_ + kLongestMove * box.diagonal().norm()));
    tree_patch_.push_back(patch);
  }
  tree_.emplace(std::move(boxes));
}

std::vector<std::int32_t> ContactCutter::patches_near(const Box3& box, std::int32_t polygon) const {
  std::vector<std::int32_t> patches;
  tree_->for_each_meeting(box, [&](std::int32_t k) {
    if (mesh_.polygon[tree_patch_[k]] == polygon) patches.push_back(tree_patch_[k]);
  });
  std::sort(patches.begin(), patches.end());
  return patches;
}

Box3 box_of(const Segment& segment, double margin) {
  Box3 box;
  for (const Vec3& end : segment) box.extend(end);
  return radiosity::grown(box, margin);
}

/// Where two segments in one plane cross, if they do.
std::optional<Vec3> crossing(const Segment& a, const Segment& b) {
  const Vec3 u = a[1] - a[0];
  const Vec3 v = b[1] - b[0];
  const Vec3 normal = u.cross(v);
  const double squared = normal.squaredNorm();
  if (squared <= kRounding * kRounding * u.squaredNorm() * v.squaredNorm()) return std::nullopt;
  const Vec3 between = b[0] - a[0];
  const double s = between.cross(v).dot(normal) / squared;
  const double t = between.cross(u).dot(normal) / squared;
  if (s < 0 || s > 1 || t < 0 || t > 1) return std::nullopt;
  return a[0] + s * u;
}

void ContactCutter::cut_polygon(std::int32_t polygon) {
  // Long ones first: the lines on which short ones end.
  std::vector<Segment> segments = lines_[polygon];
  std::stable_sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) {
    return (a[1] - a[0]).squaredNorm() > (b[1] - b[0]).squaredNorm() * (1 + kRounding);
  });
  std::vector<Box3> boxes;
  for (const Segment& segment : segments) boxes.push_back(box_of(segment, tolerance_));
  const BoxTree tree(boxes);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    for (const Vec3& end : segments[k]) catch_point(end, polygon);
    tree.for_each_meeting(boxes[k], [&](std::int32_t other) {
      if (other <= static_cast<std::int32_t>(k)) return;
      if (const auto point = crossing(segments[k], segments[other])) catch_point(*point, polygon);
    });
  }
  // Once more where moved corners have brought patches over lines that had passed them by.
  constexpr int kMostRounds = 4;
  std::size_t n_cells = 0;
  for (int round = 0; round < kMostRounds && n_cells != cells_.size(); ++round) {
    n_cells = cells_.size();
    for (std::size_t k = 0; k < segments.size(); ++k) {
      for (const std::int32_t patch : patches_near(boxes[k], polygon)) {
        const std::vector<std::int32_t> cells = cells_of_[patch];
        for (const std::int32_t cell : cells) cut_cell(cell, segments[k]);
      }
    }
  }
}

/// Moves the corner nearest to a point there, if there is one close enough.
void ContactCutter::catch_point(const Vec3& point, std::int32_t polygon) {
  std::int32_t nearest = -1;
  double distance = std::numeric_limits<double>::infinity();
  for (const std::int32_t patch : patches_near(Box3(point, point), polygon)) {
    for (const std::int32_t cell : cells_of_[patch]) {
      for (const std::int32_t v : cells_[cell].loop) {
        const double d = (at(v) - point).norm();
        if (d >= distance) continue;
        distance = d;
        nearest = v;
      }
    }
  }
  if (nearest < 0) return;
  if (distance <= tolerance_) {
    is_locked_[nearest] = true;
  } else if (distance <= kLongestMove * shortest_edge(nearest)) {
    move(nearest, point);
  }
}

double ContactCutter::shortest_edge(std::int32_t vertex) const {
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
bool ContactCutter::is_inside_polygon(const Edge& edge) const {
  const std::vector<std::int32_t>& cells = cells_on_.at(edge);
  if (cells.size() != 2) return false;
  const std::int32_t a = cells_[cells[0]].patch;
  const std::int32_t b = cells_[cells[1]].patch;
  return mesh_.polygon[a] == mesh_.polygon[b] &&
         mesh_.normal[a].cross(mesh_.normal[b]).norm() <= kRounding;
}

/// A corner within a polygon may go anywhere, one on an outline along it.
bool ContactCutter::may_move(std::int32_t vertex, const Vec3& direction) const {
  if (is_locked_[vertex]) return false;
  for (const std::int32_t cell : cells_at_[vertex]) {
    const Loop& loop = cells_[cell].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::int32_t next = loop[(k + 1) % loop.size()];
      if (loop[k] != vertex && next != vertex) continue;
      if (is_inside_polygon(edge_of(loop[k], next))) continue;
      const Vec3 along = at(next) - at(loop[k]);
      if (along.cross(direction).norm() > kRounding * along.norm() * direction.norm()) return false;
    }
  }
  return true;
}

double ContactCutter::area_in(const Loop& loop, const Vec3& normal) const {
  double area = 0;
  for (std::size_t k = 2; k < loop.size(); ++k) {
    area += normal.dot((at(loop[k - 1]) - at(loop[0])).cross(at(loop[k]) - at(loop[0])));
  }
  return area / 2;
}

/// Sines of the corners, negative where they are concave.
std::vector<double> ContactCutter::sines_in(const Loop& loop, const Vec3& normal) const {
  std::vector<double> sines;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 before = at(loop[k]) - at(loop[(k + loop.size() - 1) % loop.size()]);
    const Vec3 after = at(loop[(k + 1) % loop.size()]) - at(loop[k]);
    sines.push_back(normal.dot(before.cross(after)) / (before.norm() * after.norm()));
  }
  return sines;
}

/// Moves a corner and keeps it there; does nothing and returns false where that spoils a patch.
bool ContactCutter::move(std::int32_t vertex, const Vec3& to) {
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
      is_good = is_good && after[k] >= std::min(kLeastSine, before[k] - kRounding);
    }
    vertices_[vertex] = from;
    if (!is_good) return false;
  }
  vertices_[vertex] = to;
  is_locked_[vertex] = true;
  return true;
}

/// Puts a vertex on an edge of all cells that have it.
void ContactCutter::split_edge(std::int32_t a, std::int32_t b, const Vec3& point) {
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
  }
  cells_at_.push_back(cells);
  cells_on_[edge_of(a, made)] = cells;
  cells_on_[edge_of(made, b)] = cells;
}

void ContactCutter::enter(std::int32_t cell) {
  const Loop& loop = cells_[cell].loop;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    cells_at_[loop[k]].push_back(cell);
    cells_on_[edge_of(loop[k], loop[(k + 1) % loop.size()])].push_back(cell);
  }
}

void ContactCutter::take_out(std::int32_t cell) {
  const Loop& loop = cells_[cell].loop;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    std::erase(cells_at_[loop[k]], cell);
    std::erase(cells_on_[edge_of(loop[k], loop[(k + 1) % loop.size()])], cell);
  }
}

/// Cuts a cell between two of its vertices, given by their places in the loop, from < to.
void ContactCutter::split_cell(std::int32_t cell, std::size_t from, std::size_t to) {
  take_out(cell);
  const Loop whole = cells_[cell].loop;
  const auto first = whole.begin() + static_cast<std::ptrdiff_t>(from);
  const auto last = whole.begin() + static_cast<std::ptrdiff_t>(to);
  Loop rest(whole.begin(), first + 1);
  rest.insert(rest.end(), last, whole.end());
  cells_[cell].loop = std::move(rest);
  const std::int32_t patch = cells_[cell].patch;
  const auto made = static_cast<std::int32_t>(cells_.size());
  cells_.push_back({Loop(first, last + 1), patch});
  cells_of_[patch].push_back(made);
  enter(cell);
  enter(made);
}

void ContactCutter::cut_cell(std::int32_t cell, const Segment& segment) {
  const Vec3 along = (segment[1] - segment[0]).normalized();
  const Vec3& normal = mesh_.normal[cells_[cell].patch];
  const Vec3 across = normal.cross(along);
  const double length = (segment[1] - segment[0]).norm();
  // Parts of a polygon that is not flat lie in other planes.
  const double height = normal.dot(segment[0] - at(cells_[cell].loop[0]));
  if (std::abs(height) > 8 * tolerance_ + kRounding * length) return;
  while (true) {
    const Loop& loop = cells_[cell].loop;
    const std::size_t n = loop.size();
    std::vector<double> side;
    double size = 0;
    for (const std::int32_t v : loop) {
      const double d = across.dot(at(v) - segment[0]);
      side.push_back(std::abs(d) <= tolerance_ ? 0 : d);
      size = std::max(size, (at(v) - at(loop[0])).norm());
    }
    const auto [lowest, highest] = std::minmax_element(side.begin(), side.end());
    if (*lowest > -kLeastWidth * size || *highest < kLeastWidth * size) return;

    // Where the line is inside, measured along it.
    double enters = std::numeric_limits<double>::infinity();
    double leaves = -enters;
    std::optional<std::size_t> crossed;
    std::vector<std::size_t> on_line;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      Vec3 point = at(loop[k]);
      if (side[k] == 0) {
        on_line.push_back(k);
      } else if (side[next] == 0 || (side[k] > 0) == (side[next] > 0)) {
        continue;
      } else {
        if (!crossed) crossed = k;
        point += side[k] / (side[k] - side[next]) * (at(loop[next]) - point);
      }
      enters = std::min(enters, along.dot(point - segment[0]));
      leaves = std::max(leaves, along.dot(point - segment[0]));
    }
    const double least = std::max(2 * tolerance_, kLeastWidth * size);
    if (std::min(leaves, length) - std::max(enters, 0.0) <= least) return;
    if (!crossed) {
      const std::size_t from = on_line.front();
      const std::size_t to = on_line.back();
      // Next to each other in a loop that rounding has left not quite convex.
      if (to - from > 1 && from + n - to > 1) split_cell(cell, from, to);
      return;
    }
    const std::int32_t a = loop[*crossed];
    const std::int32_t b = loop[(*crossed + 1) % n];
    const double t = side[*crossed] / (side[*crossed] - side[(*crossed + 1) % n]);
    const Vec3 point = at(a) + t * (at(b) - at(a));
    const double share = std::min(t, 1 - t);
    if (share <= kLongestMove && move(t < 0.5 ? a : b, point)) continue;
    split_edge(a, b, point);
  }
}

/// A cell as triangles and quads without corners of 180 degrees.
std::vector<Loop> ContactCutter::patches_of(const Cell& cell) const {
  const Vec3& normal = mesh_.normal[cell.patch];
  const Loop& loop = cell.loop;
  const std::vector<double> sines = sines_in(loop, normal);
  const bool is_strict =
      std::all_of(sines.begin(), sines.end(), [](double s) { return s > kRounding; });
  if (loop.size() == 3 || (loop.size() == 4 && is_strict)) return {loop};

  std::vector<Vec3> points;
  for (const std::int32_t v : loop) points.push_back(at(v));
  const PlaneFrame frame(points);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.push_back(frame.to_plane(p));
  const std::optional<std::vector<Triangle>> ears = clip_ears(flat);
  if (!ears) return {};
  std::vector<Loop> parts;
  for (const Triangle& t : make_delaunay(flat, *ears)) {
    parts.push_back({loop[t[0]], loop[t[1]], loop[t[2]]});
  }

  // Pairs of triangles that make good quads, best first.
  while (true) {
    double best = kQuadSine;
    std::size_t first = 0;
    std::size_t second = 0;
    Loop quad;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = i + 1; j < parts.size(); ++j) {
        if (parts[i].size() != 3 || parts[j].size() != 3) continue;
        for (int k = 0; k < 3; ++k) {
          for (int m = 0; m < 3; ++m) {
            if (parts[i][k] != parts[j][(m + 1) % 3] || parts[i][(k + 1) % 3] != parts[j][m]) {
              continue;
            }
            const Loop candidate = {parts[i][k], parts[j][(m + 2) % 3], parts[i][(k + 1) % 3],
                                    parts[i][(k + 2) % 3]};
            const std::vector<double> s = sines_in(candidate, normal);
            const double worst = *std::min_element(s.begin(), s.end());
            if (worst <= best) continue;
            best = worst;
            first = i;
            second = j;
            quad = candidate;
          }
        }
      }
    }
    if (quad.empty()) return parts;
    parts[first] = std::move(quad);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

void ContactCutter::append(PatchMesh& result, const Loop& loop, std::int32_t patch) const {
  const auto corners = [](const Loop& c) {
    return std::array<std::int32_t, 4>{c[0], c[1], c[2], c.size() == 4 ? c[3] : -1};
  };
  const auto front = static_cast<std::int32_t>(result.size());
  const bool has_back = mesh_.twin[patch] >= 0;
  result.add_patch(corners(loop), mesh_.surface[patch], mesh_.polygon[patch],
                   has_back ? front + 1 : -1);
  if (!has_back) return;
  result.add_patch(corners(Loop(loop.rbegin(), loop.rend())), mesh_.surface[patch],
                   mesh_.polygon[patch], front);
  // Equal to the last bit, which summing in reverse order is not.
  result.area.back() = result.area[front];
  result.normal.back() = -result.normal[front];
  result.centroid.back() = result.centroid[front];
}

}  // namespace

PatchMesh cut_along_contacts(const PatchMesh& mesh, std::span<const std::vector<Segment>> lines,
                             Index n_fixed, const radiosity::Progress& progress) {
  const bool has_none =
      std::all_of(lines.begin(), lines.end(), [](const auto& l) { return l.empty(); });
  if (has_none) return mesh;
  return ContactCutter(mesh, lines, n_fixed, progress).run();
}

}  // namespace meshing
