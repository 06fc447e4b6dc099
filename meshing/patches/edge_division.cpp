#include "meshing/patches/edge_division.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "meshing/base/text.h"
#include "radiosity/base/disjoint_sets.h"
#include "radiosity/base/error.h"

namespace meshing {
namespace {

using radiosity::Index;
using radiosity::Vec3;

/// Opposite edges of a quad in a grid differ by no more than this factor in length, and in how
/// finely a strip may divide a quad compared with its own needs.
constexpr double kMaxRatio = 2;
/// Sine of the smallest corner angle of a quad in a grid.
constexpr double kMinSine = 0.5;
/// Rounding allowed before a length counts as longer than max_edge.
constexpr double kLengthRounding = 1e-12;

class EdgeDivider {
 public:
  EdgeDivider(const WeldedPolygons& polygons, const EdgeTable& edges,
              std::span<const PolygonKind> kinds, const EdgeLimit& limit)
      : polygons_(polygons), edges_(edges), kinds_(kinds), limit_(limit) {
    result_.max_edge = limit.coarse;
  }

  EdgeDivision run() {
    result_.is_grid.resize(kinds_.size());
    for (Index i = 0; i < polygons_.size(); ++i) {
      result_.is_grid[i] = kinds_[i] == PolygonKind::planar_quad && is_well_shaped(i);
    }
    count_own_pieces();
    do {
      count_along_strips();
    } while (leave_out_overdivided_quads());
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::int32_t edge(Index polygon, int k) const {
    return edges_.edge_of_corner[polygons_.first_corner[polygon] + k];
  }
  [[nodiscard]] double length(Index e) const {
    return (polygons_.vertices[edges_.ends[e][0]] - polygons_.vertices[edges_.ends[e][1]]).norm();
  }

  [[nodiscard]] bool is_well_shaped(Index quad) const {
    std::array<Vec3, 4> side;
    const std::span<const std::int32_t> v = polygons_.polygon(quad);
    for (int k = 0; k < 4; ++k) {
      side[k] = polygons_.vertices[v[(k + 1) % 4]] - polygons_.vertices[v[k]];
    }
    for (int k = 0; k < 4; ++k) {
      const double here = side[k].norm();
      if (here > kMaxRatio * side[(k + 2) % 4].norm()) return false;
      const Vec3& next = side[(k + 1) % 4];
      if (side[k].cross(next).norm() < kMinSine * here * next.norm()) return false;
    }
    return true;
  }

  /// What each edge needs by itself.
  void count_own_pieces() {
    std::vector<double> limit(edges_.size(), limit_.coarse);
    std::fill(limit.begin(), limit.begin() + limit_.n_fine, limit_.fine);
    own_.resize(edges_.size());
    for (Index e = 0; e < edges_.size(); ++e) {
      const double n = std::ceil(length(e) / limit[e] * (1 - kLengthRounding));
      if (n >= std::numeric_limits<std::int32_t>::max()) {
        throw radiosity::MeshError("an edge of " + number(length(e)) + " m would have " +
                                   number(n) + " pieces of at most " + number(limit[e]) +
                                   " m; ask for a larger max edge");
      }
      own_[e] = std::max(1, static_cast<std::int32_t>(n));
    }
  }

  void count_along_strips() {
    radiosity::DisjointSets classes(edges_.size());
    for (Index i = 0; i < polygons_.size(); ++i) {
      if (!result_.is_grid[i]) continue;
      classes.join(edge(i, 0), edge(i, 2));
      classes.join(edge(i, 1), edge(i, 3));
    }
    std::vector<std::int32_t>& n = result_.n_pieces;
    n = own_;
    for (Index e = 0; e < edges_.size(); ++e) {
      std::int32_t& largest = n[classes.find(e)];
      largest = std::max(largest, own_[e]);
    }
    for (Index e = 0; e < edges_.size(); ++e) {
      n[e] = n[classes.find(e)];
    }
  }

  /// True if there were any; their strips end there.
  bool leave_out_overdivided_quads() {
    bool found = false;
    for (Index i = 0; i < polygons_.size(); ++i) {
      if (!result_.is_grid[i]) continue;
      for (const int k : {0, 1}) {
        const std::int32_t own = std::max(own_[edge(i, k)], own_[edge(i, k + 2)]);
        if (result_.n_pieces[edge(i, k)] > kMaxRatio * own) {
          result_.is_grid[i] = false;
          found = true;
        }
      }
    }
    return found;
  }

  const WeldedPolygons& polygons_;
  const EdgeTable& edges_;
  std::span<const PolygonKind> kinds_;
  const EdgeLimit& limit_;
  std::vector<std::int32_t> own_;
  EdgeDivision result_;
};

}  // namespace

EdgeDivision divide_edges(const WeldedPolygons& polygons, const EdgeTable& edges,
                          std::span<const PolygonKind> kinds, const EdgeLimit& limit) {
  if (std::isinf(limit.coarse) && limit.n_fine == 0) {
    EdgeDivision as_is;
    as_is.max_edge = limit.coarse;
    as_is.n_pieces.assign(edges.size(), 1);
    as_is.is_grid.assign(kinds.size(), false);
    return as_is;
  }
  return EdgeDivider(polygons, edges, kinds, limit).run();
}

}  // namespace meshing
