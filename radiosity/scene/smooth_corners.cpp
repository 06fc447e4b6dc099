#include "radiosity/scene/smooth_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace radiosity {
namespace {

/// Largest distance of a T-vertex from the edge it lies on, relative to the edge's length.
constexpr double kOnEdge = 1e-4;

/// Per vertex: the first vertex, in a fixed order, that has the same position.
std::vector<std::int32_t> weld(const std::vector<Vec3>& vertices) {
  std::vector<std::int32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](std::int32_t a, std::int32_t b) {
    return std::lexicographical_compare(vertices[a].begin(), vertices[a].end(), vertices[b].begin(),
                                        vertices[b].end());
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<std::int32_t> point(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || before(order[i - 1], order[i]);
    point[order[i]] = is_new ? order[i] : point[order[i - 1]];
  }
  return point;
}

/// Splits slots of one point and surface into sets whose normals hang together.
std::vector<std::vector<std::int64_t>> split_by_crease(const PatchMesh& mesh,
                                                       std::span<const std::int64_t> slots,
                                                       double min_cosine) {
  std::vector<std::vector<std::int64_t>> sets;
  for (const std::int64_t slot : slots) {
    const Vec3& normal = mesh.normal[slot / 4];
    std::vector<std::int64_t> joined = {slot};
    std::erase_if(sets, [&](std::vector<std::int64_t>& set) {
      const bool is_smooth = std::any_of(set.begin(), set.end(), [&](std::int64_t other) {
        return normal.dot(mesh.normal[other / 4]) >= min_cosine;
      });
      if (!is_smooth) return false;
      set.insert(set.end(), joined.begin(), joined.end());
      joined.swap(set);
      return true;
    });
    sets.push_back(std::move(joined));
  }
  return sets;
}

/// The vertex at a slot.
std::int32_t vertex_at(const PatchMesh& mesh, std::int64_t slot) {
  return mesh.corners[slot / 4][slot % 4];
}

/// Where a slot's corner is, m.
const Vec3& position_at(const PatchMesh& mesh, std::int64_t slot) {
  return mesh.vertices[vertex_at(mesh, slot)];
}

/// Slot of the corner after (step 1) or before (step -1) a slot's corner in its patch.
std::int64_t neighbor_slot(const PatchMesh& mesh, std::int64_t slot, int step) {
  const std::int64_t patch = slot / 4;
  const int n = mesh.n_corners(patch);
  return 4 * patch + (slot % 4 + n + step) % n;
}

/// Whether the patches of a group close a ring around it: each edge that leaves it is shared by
/// two.
bool closes_ring(const PatchMesh& mesh, const std::vector<std::int32_t>& point,
                 std::span<const std::int64_t> group) {
  std::vector<std::int32_t> ends;
  for (const std::int64_t slot : group) {
    for (const int step : {-1, 1}) {
      ends.push_back(point[vertex_at(mesh, neighbor_slot(mesh, slot, step))]);
    }
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    if (ends[i] != ends[i + 1] || (i + 2 < ends.size() && ends[i] == ends[i + 2])) return false;
  }
  return true;
}

/// Fills in everything but the T-vertices.
SmoothCorners join_corners(const PatchMesh& mesh, const std::vector<std::int32_t>& point,
                           double min_cosine) {
  struct Corner {
    std::int32_t point;
    std::int32_t surface;
    std::int64_t slot;
    auto operator<=>(const Corner&) const = default;
  };
  std::vector<Corner> corners;
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      corners.push_back({point[mesh.corners[i][k]], mesh.surface[i], 4 * i + k});
    }
  }
  std::sort(corners.begin(), corners.end());

  SmoothCorners groups;
  groups.group_of.assign(4 * mesh.size(), -1);
  groups.first_slot = {0};
  std::vector<std::int64_t> run;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    run.push_back(corners[i].slot);
    const bool is_last = i + 1 == corners.size() || corners[i + 1].point != corners[i].point ||
                         corners[i + 1].surface != corners[i].surface;
    if (!is_last) continue;
    for (const auto& set : split_by_crease(mesh, run, min_cosine)) {
      for (const std::int64_t slot : set) {
        groups.group_of[slot] = static_cast<std::int32_t>(groups.size());
      }
      groups.slots.insert(groups.slots.end(), set.begin(), set.end());
      groups.first_slot.push_back(static_cast<std::int64_t>(groups.slots.size()));
      groups.is_interior.push_back(closes_ring(mesh, point, set) ? 1 : 0);
    }
    run.clear();
  }
  return groups;
}

/// A patch edge across which nothing goes on smoothly, from slot to slot.
struct OpenEdge {
  std::int64_t from;
  std::int64_t to;
  double length;
};

/// The edges that only one patch has, longest first.
std::vector<OpenEdge> open_edges(const PatchMesh& mesh, const SmoothCorners& groups) {
  struct Side {
    std::int32_t low;   // the groups at its ends: two patches that are smooth across an edge
    std::int32_t high;  // share both
    std::int64_t slot;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  for (const std::int64_t slot : groups.slots) {
    const std::int32_t a = groups.group_of[slot];
    const std::int32_t b = groups.group_of[neighbor_slot(mesh, slot, 1)];
    sides.push_back({std::min(a, b), std::max(a, b), slot});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<OpenEdge> edges;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto same = [&](std::size_t k) {
      return sides[k].low == sides[i].low && sides[k].high == sides[i].high;
    };
    if ((i > 0 && same(i - 1)) || (i + 1 < sides.size() && same(i + 1))) continue;
    const std::int64_t from = sides[i].slot;
    const std::int64_t to = neighbor_slot(mesh, from, 1);
    const double length = (position_at(mesh, to) - position_at(mesh, from)).norm();
    if (length > 0) edges.push_back({from, to, length});
  }
  std::sort(edges.begin(), edges.end(), [](const OpenEdge& a, const OpenEdge& b) {
    return a.length != b.length ? a.length > b.length : a.from < b.from;
  });
  return edges;
}

/// Finds groups near a position, by a grid of cubic cells.
class GroupGrid {
 public:
  GroupGrid(const PatchMesh& mesh, const SmoothCorners& groups, std::span<const OpenEdge> edges,
            double cell)
      : cell_(cell) {
    std::vector<std::uint8_t> is_in(groups.size(), 0);
    for (const OpenEdge& edge : edges) {
      for (const std::int64_t slot : {edge.from, edge.to}) {
        const std::int32_t group = groups.group_of[slot];
        if (is_in[group] != 0) continue;
        is_in[group] = 1;
        cells_[key(cell_of(position_at(mesh, slot)))].push_back(group);
      }
    }
  }

  /// Calls visit(group) for all groups in a box, and some others.
  void for_each_in(const Box3& box, const std::function<void(std::int32_t)>& visit) const {
    const Cell low = cell_of(box.min());
    const Cell high = cell_of(box.max());
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = cells_.find(key({x, y, z}));
          if (found == cells_.end()) continue;
          for (const std::int32_t group : found->second) visit(group);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell cell_of(const Vec3& x) const {
    return {std::llround(x[0] / cell_), std::llround(x[1] / cell_), std::llround(x[2] / cell_)};
  }
  /// Cells that share a key only cost time, as each candidate is checked.
  static std::uint64_t key(const Cell& cell) {
    return static_cast<std::uint64_t>(cell[0]) * 0x9E3779B97F4A7C15U ^
           static_cast<std::uint64_t>(cell[1]) * 0xC2B2AE3D27D4EB4FU ^
           static_cast<std::uint64_t>(cell[2]) * 0x165667B19E3779F9U;
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

/// Fraction of the way along an edge at which a group lies, if it lies inside it and its surface
/// goes on smoothly into the edge's patch.
std::optional<double> position_on_edge(const PatchMesh& mesh, const SmoothCorners& groups,
                                       std::int32_t group, const OpenEdge& edge,
                                       double min_cosine) {
  const std::int64_t patch = edge.from / 4;
  const auto slots = groups.group(group);
  if (mesh.surface[slots[0] / 4] != mesh.surface[patch]) return std::nullopt;
  const Vec3& start = position_at(mesh, edge.from);
  const Vec3 along = position_at(mesh, edge.to) - start;
  const Vec3 offset = position_at(mesh, slots[0]) - start;
  const double t = offset.dot(along) / along.squaredNorm();
  if (t < kOnEdge || t > 1 - kOnEdge) return std::nullopt;
  if ((offset - t * along).norm() > kOnEdge * edge.length) return std::nullopt;
  const bool is_smooth = std::any_of(slots.begin(), slots.end(), [&](std::int64_t slot) {
    return mesh.normal[slot / 4].dot(mesh.normal[patch]) >= min_cosine;
  });
  return is_smooth ? std::optional(t) : std::nullopt;
}

std::vector<TVertex> find_t_vertices(const PatchMesh& mesh, const SmoothCorners& groups,
                                     double min_cosine) {
  const std::vector<OpenEdge> edges = open_edges(mesh, groups);
  double total_length = 0;
  for (const OpenEdge& edge : edges) total_length += edge.length;
  if (edges.empty()) return {};
  // The mean length as cell width makes as many steps along edges, below, as there are edges.
  const double cell = total_length / static_cast<double>(edges.size());
  const GroupGrid grid(mesh, groups, edges, cell);

  std::vector<TVertex> t_vertices;
  std::vector<std::uint8_t> is_found(groups.size(), 0);
  for (const OpenEdge& edge : edges) {
    const Vec3& start = position_at(mesh, edge.from);
    const Vec3& end = position_at(mesh, edge.to);
    const Vec3 margin = Vec3::Constant(kOnEdge * edge.length);
    const int n_steps = static_cast<int>(std::ceil(edge.length / cell));
    const Vec3 step = (end - start) / n_steps;
    for (int k = 0; k < n_steps; ++k) {
      Box3 box(start + k * step);
      box.extend(start + (k + 1) * step);
      box = Box3(box.min() - margin, box.max() + margin);
      grid.for_each_in(box, [&](std::int32_t group) {
        if (is_found[group] != 0) return;
        const auto t = position_on_edge(mesh, groups, group, edge, min_cosine);
        if (!t) return;
        is_found[group] = 1;
        t_vertices.push_back({group, edge.from, edge.to, *t});
      });
    }
  }
  return t_vertices;
}

}  // namespace

SmoothCorners make_smooth_corners(const PatchMesh& mesh, double crease_angle) {
  // Unit normals of one plane differ by rounding even where no crease is wanted at all.
  const double min_cosine = std::cos(crease_angle) - 1e-12;
  SmoothCorners groups = join_corners(mesh, weld(mesh.vertices), min_cosine);
  groups.t_vertices = find_t_vertices(mesh, groups, min_cosine);
  return groups;
}

}  // namespace radiosity
