#include "radiosity/scene/surface_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/disjoint_sets.h"
#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// Facets at a smaller angle around an edge lie in one plane with nothing between them: the least
/// such angle, the same in thicknesses over the facets' widths, since it is not known better, and
/// the largest.
constexpr double kSameAngle = 1e-5;
constexpr double kSameThicknesses = 3;
constexpr double kMostSameAngle = 0.5;

using Place = std::array<std::int64_t, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::uint64_t hash = 0;
    for (const std::int64_t coordinate : place) {
      hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

class Joiner {
 public:
  Joiner(const PatchMesh& mesh, const std::vector<std::int32_t>& patches, double thickness)
      : thickness_(thickness) {
    result_.first_corner.push_back(0);
    for (const std::int32_t i : patches) {
      for (int k = 0; k < mesh.n_corners(i); ++k) {
        vertex_.push_back(mesh.corners[i][k]);
        result_.corners.push_back(mesh.corner(i, k));
        result_.facet.push_back(static_cast<std::int32_t>(result_.normal.size()));
      }
      result_.first_corner.push_back(static_cast<std::int32_t>(result_.corners.size()));
      result_.normal.push_back(mesh.normal[i]);
    }
    result_.neighbor.assign(result_.corners.size(), -1);
  }

  SurfacePieces run() {
    weld();
    split_edges();
    join_edges();
    collect();
    return std::move(result_);
  }

 private:
  /// Numbers points alike that are equal, or no further apart than the thickness.
  void weld() {
    struct Corner {
      std::array<double, 3> place;
      std::int32_t number;
      bool operator<(const Corner& other) const {
        return place != other.place ? place < other.place : number < other.number;
      }
    };
    // Of those that are one vertex the first stands for all.
    std::vector<Corner> sorted;
    std::vector<std::int32_t> first_of(
        vertex_.empty() ? 0 : *std::max_element(vertex_.begin(), vertex_.end()) + 1, -1);
    for (std::size_t k = 0; k < vertex_.size(); ++k) {
      std::int32_t& first = first_of[vertex_[k]];
      if (first >= 0) continue;
      first = static_cast<std::int32_t>(k);
      const Vec3& corner = result_.corners[k];
      sorted.push_back({{corner.x(), corner.y(), corner.z()}, first});
    }
    std::sort(sorted.begin(), sorted.end());
    point_.resize(vertex_.size());
    earlier_.resize(vertex_.size());
    latest_in_.reserve(sorted.size());
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const bool is_new = k == 0 || sorted[k].place != sorted[k - 1].place;
      point_[sorted[k].number] =
          is_new ? representative(sorted[k].number) : point_[sorted[k - 1].number];
    }
    for (std::size_t k = 0; k < vertex_.size(); ++k) point_[k] = point_[first_of[vertex_[k]]];
    latest_in_ = {};
    earlier_ = {};
  }

  /// The first point found within the thickness, or the point itself.
  std::int32_t representative(std::int32_t k) {
    // Cells are so much larger that a point rarely lies near the border of one.
    constexpr double kCell = 64;
    const Vec3 place = result_.corners[k] / std::max(kCell * thickness_, 1e-300);
    const Vec3 reach = Vec3::Constant(1 / kCell);
    Place low;
    Place high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = static_cast<std::int64_t>(std::floor(place[axis] - reach[axis]));
      high[axis] = static_cast<std::int64_t>(std::floor(place[axis] + reach[axis]));
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const std::int32_t found = first_near(k, Place{x, y, z});
          if (found >= 0) return found;
        }
      }
    }
    Place own;
    for (int axis = 0; axis < 3; ++axis) {
      own[axis] = static_cast<std::int64_t>(std::floor(place[axis]));
    }
    const auto [latest, is_new] = latest_in_.try_emplace(own, k);
    earlier_[k] = is_new ? -1 : latest->second;
    latest->second = k;
    return k;
  }

  /// The point that came first of those in a cell within the thickness of another; -1 if none is.
  [[nodiscard]] std::int32_t first_near(std::int32_t k, const Place& cell) const {
    const auto latest = latest_in_.find(cell);
    std::int32_t first = -1;
    if (latest == latest_in_.end()) return first;
    for (std::int32_t other = latest->second; other >= 0; other = earlier_[other]) {
      const double square = (result_.corners[other] - result_.corners[k]).squaredNorm();
      if (square <= thickness_ * thickness_) first = other;
    }
    return first;
  }

  struct Edge {
    std::int32_t low, high;  // points
    std::int32_t half_edge;
    [[nodiscard]] auto key() const { return std::pair(low, high); }
  };

  void join_edges() {
    const std::vector<Edge> edges = sorted_edges();
    for (std::size_t first = 0; first < edges.size();) {
      std::size_t last = first + 1;
      while (last < edges.size() && edges[last].key() == edges[first].key()) ++last;
      join_at_edge({edges.data() + first, last - first});
      first = last;
    }
  }

  /// All edges by their points, first in buckets by the lower one.
  [[nodiscard]] std::vector<Edge> sorted_edges() const {
    const auto n = static_cast<std::int32_t>(point_.size());
    const auto edge = [this](std::int32_t h) {
      const std::int32_t a = point_[h];
      const std::int32_t b = point_[result_.next(h)];
      return Edge{std::min(a, b), std::max(a, b), h};
    };
    std::vector<std::int32_t> end_of(point_.size() + 1, 0);
    for (std::int32_t h = 0; h < n; ++h) {
      const Edge e = edge(h);
      if (e.low != e.high) ++end_of[e.low + 1];
    }
    std::partial_sum(end_of.begin(), end_of.end(), end_of.begin());
    std::vector<Edge> edges(end_of.back());
    for (std::int32_t h = 0; h < n; ++h) {
      const Edge e = edge(h);
      if (e.low != e.high) edges[end_of[e.low]++] = e;
    }
    std::int32_t begin = 0;
    for (std::int32_t point = 0; point < n; ++point) {
      std::sort(edges.begin() + begin, edges.begin() + end_of[point],
                [](const Edge& a, const Edge& b) {
                  return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
                });
      begin = end_of[point];
    }
    return edges;
  }

  /// Where facets were divided otherwise than their neighbours, the ends of some edges lie within
  /// others: makes them corners there, too.
  void split_edges() {
    const std::vector<std::vector<PointWithin>> within = points_within_edges();
    if (std::all_of(within.begin(), within.end(), [](const auto& some) { return some.empty(); }))
      return;
    SurfacePieces split;
    std::vector<std::int32_t> split_point;
    std::vector<std::int32_t> corner_of(point_.size());  // in `split`
    std::size_t next = 0;                                // of the points within, in their chunk
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(point_.size()); ++h) {
      const std::int32_t f = result_.facet[h];
      if (h == result_.first_corner[f]) {
        split.first_corner.push_back(static_cast<std::int32_t>(split.corners.size()));
      }
      corner_of[h] = static_cast<std::int32_t>(split.corners.size());
      const auto add = [&](std::int32_t corner) {
        split.corners.push_back(result_.corners[corner]);
        split.facet.push_back(f);
        split_point.push_back(point_[corner]);
      };
      add(h);
      const std::vector<PointWithin>& of_chunk = within[f / kChunk];
      if (h == result_.first_corner[f] && f % kChunk == 0) next = 0;
      for (; next < of_chunk.size() && of_chunk[next].half_edge == h; ++next) {
        add(of_chunk[next].point);
      }
    }
    split.first_corner.push_back(static_cast<std::int32_t>(split.corners.size()));
    for (std::int32_t& point : split_point) point = corner_of[point];
    split.normal = std::move(result_.normal);
    split.neighbor.assign(split.corners.size(), -1);
    result_ = std::move(split);
    point_ = std::move(split_point);
  }

  /// A point on a half-edge that is none of its ends.
  struct PointWithin {
    std::int32_t half_edge;
    double along;  // from its start, m
    std::int32_t point;
    auto operator<=>(const PointWithin&) const = default;
  };
  /// Facets that are looked at one after the other.
  static constexpr std::int32_t kChunk = 256;

  /// The points on half-edges, for each chunk of facets, by the half-edge and along it.
  [[nodiscard]] std::vector<std::vector<PointWithin>> points_within_edges() const {
    const auto n = static_cast<std::int32_t>(point_.size());
    std::vector<std::int32_t> points;
    std::vector<Box3> boxes;
    for (std::int32_t k = 0; k < n; ++k) {
      if (point_[k] != k) continue;
      points.push_back(k);
      boxes.emplace_back(result_.corners[k], result_.corners[k]);
    }
    const BoxTree tree(std::move(boxes));
    const auto n_facets = static_cast<std::int32_t>(result_.normal.size());
    std::vector<std::vector<PointWithin>> within((n_facets + kChunk - 1) / kChunk);
    parallel_for(static_cast<std::ptrdiff_t>(within.size()), [&](std::ptrdiff_t chunk) {
      const auto begin = static_cast<std::int32_t>(chunk) * kChunk;
      std::vector<std::int32_t> near;
      for (std::int32_t f = begin; f < std::min(n_facets, begin + kChunk); ++f) {
        Box3 box;
        for (const Vec3& corner : result_.outline(f)) box.extend(corner);
        near.clear();
        tree.for_each_meeting(grown(box, thickness_),
                              [&](std::int32_t k) { near.push_back(points[k]); });
        for (std::int32_t h = result_.first_corner[f]; h < result_.first_corner[f + 1]; ++h) {
          add_points_within(h, near, within[chunk]);
        }
      }
      std::sort(within[chunk].begin(), within[chunk].end());
    });
    return within;
  }

  void add_points_within(std::int32_t h, const std::vector<std::int32_t>& near,
                         std::vector<PointWithin>& within) const {
    const Vec3& start = result_.corners[h];
    const Vec3& end = result_.corners[result_.next(h)];
    const Vec3 way = end - start;
    const double length = way.norm();
    if (length <= 2 * thickness_) return;
    Box3 box(start, start);
    box.extend(end);
    box = grown(box, thickness_);
    for (const std::int32_t point : near) {
      if (point == point_[h] || point == point_[result_.next(h)]) continue;
      if (!box.contains(result_.corners[point])) continue;
      const Vec3 off = result_.corners[point] - start;
      const double along = off.dot(way) / length;
      if (along <= thickness_ || along >= length - thickness_) continue;
      if ((off - along / length * way).norm() <= thickness_) within.push_back({h, along, point});
    }
  }

  void join(std::int32_t a, std::int32_t b) {
    result_.neighbor[a] = b;
    result_.neighbor[b] = a;
  }

  /// How far the facet of a half-edge reaches from its line.
  [[nodiscard]] double width(std::int32_t half_edge, const Vec3& axis) const {
    double result = 0;
    for (const Vec3& corner : result_.outline(result_.facet[half_edge])) {
      result = std::max(result, axis.cross(corner - result_.corners[half_edge]).norm());
    }
    return result;
  }

  void join_at_edge(std::span<const Edge> edges) {
    std::vector<std::int32_t> forward;
    std::vector<std::int32_t> backward;
    for (const Edge& edge : edges) {
      (point_[edge.half_edge] == edge.low ? forward : backward).push_back(edge.half_edge);
    }
    if (forward.size() == 1 && backward.size() == 1) {
      join(forward[0], backward[0]);
      return;
    }
    if (forward.empty() || backward.empty()) return;
    // Seen along the edge, the matter of a facet that runs forward is clockwise of it.
    const Vec3 axis = (result_.corners[edges[0].high] - result_.corners[edges[0].low]).normalized();
    const Vec3 u = axis.unitOrthogonal();
    const Vec3 v = axis.cross(u);
    const auto angle = [&](std::int32_t half_edge, double way) {
      const Vec3 inwards = way * result_.normal[result_.facet[half_edge]].cross(axis);
      return std::atan2(v.dot(inwards), u.dot(inwards));
    };
    struct Wedge {
      double angle;
      std::int32_t forward, backward;
    };
    std::vector<Wedge> wedges;
    for (const std::int32_t f : forward) {
      for (const std::int32_t b : backward) {
        double wedge = angle(f, 1) - angle(b, -1);
        const double same =
            std::clamp(kSameThicknesses * thickness_ * (1 / width(f, axis) + 1 / width(b, axis)),
                       kSameAngle, kMostSameAngle);
        while (wedge <= same) wedge += 2 * kPi;
        while (wedge > 2 * kPi + same) wedge -= 2 * kPi;
        wedges.push_back({wedge, f, b});
      }
    }
    std::stable_sort(wedges.begin(), wedges.end(),
                     [](const Wedge& a, const Wedge& b) { return a.angle < b.angle; });
    for (const Wedge& wedge : wedges) {
      if (result_.neighbor[wedge.forward] < 0 && result_.neighbor[wedge.backward] < 0) {
        join(wedge.forward, wedge.backward);
      }
    }
  }

  void collect() {
    DisjointSets sets(static_cast<Index>(result_.normal.size()));
    for (std::size_t h = 0; h < result_.neighbor.size(); ++h) {
      if (result_.neighbor[h] >= 0) {
        sets.join(result_.facet[h], result_.facet[result_.neighbor[h]]);
      }
    }
    for (const std::vector<Index>& set : sets.sets()) {
      SurfacePiece& piece = result_.pieces.emplace_back();
      const Vec3 origin = result_.corners[result_.first_corner[set.front()]];
      double area = 0;
      for (const Index f : set) {
        piece.facets.push_back(static_cast<std::int32_t>(f));
        for (std::int32_t h = result_.first_corner[f]; h < result_.first_corner[f + 1]; ++h) {
          if (result_.neighbor[h] < 0) piece.open_edges.push_back(h);
        }
        const std::span<const Vec3> outline = result_.outline(static_cast<std::int32_t>(f));
        const Vec3 facet_area = vector_area(outline);
        piece.volume += facet_area.dot(outline[0] - origin) / 3;
        area += facet_area.norm();
      }
      // Two walls back to back enclose nothing.
      if (std::abs(piece.volume) <= thickness_ * area) piece.volume = 0;
    }
  }

  double thickness_;
  SurfacePieces result_;
  std::vector<std::int32_t> vertex_;  // per corner: of the mesh
  std::vector<std::int32_t> point_;   // per corner: the first one in the same place
  // Points by the cell that they are in: the latest of each, and before each point the earlier one.
  std::unordered_map<Place, std::int32_t, PlaceHash> latest_in_;
  std::vector<std::int32_t> earlier_;
};

}  // namespace

SurfacePieces find_surface_pieces(const PatchMesh& mesh, const std::vector<std::int32_t>& patches,
                                  double thickness) {
  return Joiner(mesh, patches, thickness).run();
}

}  // namespace radiosity
