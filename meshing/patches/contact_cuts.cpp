#include "meshing/patches/contact_cuts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "meshing/base/triangulate.h"
#include "meshing/patches/halfedge.h"
#include "meshing/patches/patch_cells.h"
#include "meshing/patches/patch_finder.h"
#include "radiosity/base/box_tree.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::BoxTree;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// Two triangles become a quad if its corners have this sine.
constexpr double kQuadSine = 0.4;
/// What is narrower than this share of its length is not cut off.
constexpr double kLeastWidth = 1e-5;
/// Rounding of directions.
constexpr double kCutRounding = 1e-9;

/// The patches that some line may cut or move a corner of, and those that share a corner with one:
/// what is done to a corner or an edge concerns all that have it.
std::vector<std::int32_t> patches_concerned(const PatchMesh& mesh, const PatchFinder& finder,
                                            std::span<const std::vector<Segment>> lines) {
  std::vector<bool> has_corner(mesh.vertices.size(), false);
  for (std::size_t p = 0; p < lines.size(); ++p) {
    for (const Segment& segment : lines[p]) {
      for (const std::int32_t patch : finder.near(segment, static_cast<std::int32_t>(p))) {
        for (int k = 0; k < mesh.n_corners(patch); ++k) has_corner[mesh.corners[patch][k]] = true;
      }
    }
  }
  std::vector<std::int32_t> patches;
  for (std::int32_t i = 0; i < mesh.size(); ++i) {
    if (mesh.twin[i] >= 0 && mesh.twin[i] < i) continue;
    const auto& corners = mesh.corners[i];
    if (std::any_of(corners.begin(), corners.begin() + mesh.n_corners(i),
                    [&](std::int32_t corner) { return has_corner[corner]; })) {
      patches.push_back(i);
    }
  }
  return patches;
}

class ContactCutter {
 public:
  ContactCutter(const PatchMesh& mesh, std::span<const std::vector<Segment>> lines, Index n_fixed,
                const radiosity::Progress& progress)
      : mesh_(mesh),
        lines_(lines),
        progress_(progress),
        tolerance_(radiosity::plane_thickness(mesh)),
        finder_(mesh, lines, tolerance_),
        cells_(mesh, n_fixed, patches_concerned(mesh, finder_, lines)) {}

  PatchMesh run();

 private:
  void cut_polygon(std::int32_t polygon);
  void catch_point(const Vec3& point, std::int32_t polygon);
  void cut_cell(std::int32_t cell, const Segment& segment);

  [[nodiscard]] std::vector<Loop> patches_of(const Cell& cell) const;
  [[nodiscard]] std::vector<Loop> with_quads(std::vector<Loop> parts, const Vec3& normal) const;
  void append_patches(const Cell& cell, PatchMesh& result) const;
  void append(PatchMesh& result, const Loop& loop, std::int32_t patch) const;

  [[nodiscard]] const Vec3& at(std::int32_t vertex) const { return cells_.at(vertex); }

  const PatchMesh& mesh_;
  std::span<const std::vector<Segment>> lines_;
  const radiosity::Progress& progress_;
  double tolerance_;
  PatchFinder finder_;
  PatchCells cells_;
};

PatchMesh ContactCutter::run() {
  for (std::size_t p = 0; p < lines_.size(); ++p) {
    if (lines_[p].empty()) continue;
    progress_.check();
    cut_polygon(static_cast<std::int32_t>(p));
  }
  PatchMesh result;
  result.vertices = cells_.vertices();
  result.surface_names = mesh_.surface_names;
  result.surface_two_sided = mesh_.surface_two_sided;
  result.precision = mesh_.precision;
  result.polygon_corners = mesh_.polygon_corners;
  result.first_polygon_corner = mesh_.first_polygon_corner;
  result.reserve(mesh_.size());
  for (std::int32_t i = 0; i < mesh_.size(); ++i) {
    if (mesh_.twin[i] >= 0 && mesh_.twin[i] < i) continue;
    const std::vector<std::int32_t>& cells = cells_.of_patch(i);
    for (const std::int32_t cell : cells) append_patches(cells_[cell], result);
    if (!cells.empty()) continue;
    if (mesh_.n_corners(i) == 3 && mesh_.twin[i] < 0) {
      result.add_patch(mesh_.corners[i], mesh_.surface[i], mesh_.polygon[i]);
    } else {
      append_patches(cells_.whole(i), result);
    }
  }
  return result;
}

/// Where two segments in one plane cross, if they do.
std::optional<Vec3> crossing(const Segment& a, const Segment& b) {
  const Vec3 u = a[1] - a[0];
  const Vec3 v = b[1] - b[0];
  const Vec3 normal = u.cross(v);
  const double squared = normal.squaredNorm();
  if (squared <= kCutRounding * kCutRounding * u.squaredNorm() * v.squaredNorm())
    return std::nullopt;
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
    return (a[1] - a[0]).squaredNorm() > (b[1] - b[0]).squaredNorm() * (1 + kCutRounding);
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
      for (const std::int32_t patch : finder_.near(segments[k], polygon)) {
        // Nothing that a line cuts for more than twice the tolerance is outside of such a box.
        cells_.for_each_near(patch, radiosity::grown(boxes[k], 4 * tolerance_),
                             [&](std::int32_t cell) { cut_cell(cell, segments[k]); });
      }
    }
  }
}

/// Moves the corner nearest to a point there, if there is one close enough.
void ContactCutter::catch_point(const Vec3& point, std::int32_t polygon) {
  std::int32_t nearest = -1;
  double distance = std::numeric_limits<double>::infinity();
  for (const std::int32_t patch : finder_.near(point, polygon)) {
    for (const std::int32_t cell : cells_.of_patch(patch)) {
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
    cells_.lock(nearest);
  } else if (distance <= PatchFinder::kLongestMove * cells_.shortest_edge(nearest)) {
    cells_.move(nearest, point);
  }
}

void ContactCutter::cut_cell(std::int32_t cell, const Segment& segment) {
  const Vec3 along = (segment[1] - segment[0]).normalized();
  const Vec3& normal = mesh_.normal[cells_[cell].patch];
  const Vec3 across = normal.cross(along);
  const double length = (segment[1] - segment[0]).norm();
  // A line is known as well as the ends of its segment, and less well further on.
  const auto is_on_line = [&](const Vec3& point, double off) {
    const double t = along.dot(point - segment[0]);
    const double beyond = std::max({0.0, -t, t - length});
    return std::abs(off) <= tolerance_ * (1 + 2 * beyond / length);
  };
  // Parts of a polygon that is not flat lie in other planes.
  const double height = normal.dot(segment[0] - at(cells_[cell].loop[0]));
  if (std::abs(height) > 8 * tolerance_ + kCutRounding * length) return;
  while (true) {
    const Loop& loop = cells_[cell].loop;
    const std::size_t n = loop.size();
    std::vector<double> side;
    double size = 0;
    for (const std::int32_t v : loop) {
      const double d = across.dot(at(v) - segment[0]);
      side.push_back(is_on_line(at(v), d) ? 0 : d);
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
      if (to - from > 1 && from + n - to > 1) cells_.split_cell(cell, from, to);
      return;
    }
    const std::int32_t a = loop[*crossed];
    const std::int32_t b = loop[(*crossed + 1) % n];
    const double t = side[*crossed] / (side[*crossed] - side[(*crossed + 1) % n]);
    const Vec3 point = at(a) + t * (at(b) - at(a));
    const double share = std::min(t, 1 - t);
    if (share <= PatchFinder::kLongestMove && cells_.move(t < 0.5 ? a : b, point)) continue;
    cells_.split_edge(a, b, point);
  }
}

/// A cell as triangles and quads without corners of 180 degrees.
std::vector<Loop> ContactCutter::patches_of(const Cell& cell) const {
  const Vec3& normal = mesh_.normal[cell.patch];
  const Loop& loop = cell.loop;
  const std::vector<double> sines = cells_.sines_in(loop, normal);
  const bool is_strict =
      std::all_of(sines.begin(), sines.end(), [](double s) { return s > kCutRounding; });
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

  return with_quads(std::move(parts), normal);
}

/// Triangles, of which pairs that make good quads do so, best first.
std::vector<Loop> ContactCutter::with_quads(std::vector<Loop> parts, const Vec3& normal) const {
  struct Side {
    std::int32_t from, to;
    std::size_t part, corner;
    bool operator<(const Side& other) const {
      return std::tie(from, to, part, corner) <
             std::tie(other.from, other.to, other.part, other.corner);
    }
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      sides.push_back({parts[i][k], parts[i][(k + 1) % 3], i, k});
    }
  }
  std::sort(sides.begin(), sides.end());
  struct Pair {
    double worst;  // sine of a corner
    std::size_t first, second;
    Loop quad;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = parts[i][k];
      const std::int32_t to = parts[i][(k + 1) % 3];
      // Those that run back, of later triangles.
      for (auto side = std::lower_bound(sides.begin(), sides.end(), Side{to, from, i + 1, 0});
           side != sides.end() && side->from == to && side->to == from; ++side) {
        Loop quad = {from, parts[side->part][(side->corner + 2) % 3], to, parts[i][(k + 2) % 3]};
        const std::vector<double> sines = cells_.sines_in(quad, normal);
        const double worst = *std::min_element(sines.begin(), sines.end());
        if (worst > kQuadSine) pairs.push_back({worst, i, side->part, std::move(quad)});
      }
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(b.worst, a.first, a.second) < std::tie(a.worst, b.first, b.second);
  });
  std::vector<bool> is_paired(parts.size(), false);
  for (Pair& pair : pairs) {
    if (is_paired[pair.first] || is_paired[pair.second]) continue;
    is_paired[pair.first] = is_paired[pair.second] = true;
    parts[pair.first] = std::move(pair.quad);
    parts[pair.second].clear();
  }
  std::erase_if(parts, [](const Loop& part) { return part.empty(); });
  return parts;
}

void ContactCutter::append_patches(const Cell& cell, PatchMesh& result) const {
  for (const Loop& loop : patches_of(cell)) append(result, loop, cell.patch);
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
