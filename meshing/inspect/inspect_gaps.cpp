#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "meshing/base/text.h"
#include "meshing/inspect/findings.h"
#include "radiosity/base/box_tree.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::BoxTree;
using radiosity::Index;
using radiosity::Vec3;

// All relative to the diagonal of the scene.
constexpr double kSamePlace = 1e-7;   ///< vertices this close are nearly the same
constexpr double kOnEdge = 1e-6;      ///< a vertex this close to an edge lies on it
constexpr double kAlmostMeet = 1e-4;  ///< boundaries this close were meant to meet
/// A gap is narrower than this part of the edges beside it; otherwise it is a detail of the scene.
constexpr double kNarrow = 0.1;

/// Edges that one polygon has for itself.
struct BoundaryEdges {
  std::vector<std::int32_t> edges;
  std::vector<double> shortest_at;  ///< per vertex: its shortest boundary edge, m; 0 if none
};

BoundaryEdges boundary_edges(const ExaminedScene& examined) {
  BoundaryEdges result;
  result.shortest_at.assign(examined.polygons.vertices.size(), 0.0);
  for (Index e = 0; e < examined.edges.size(); ++e) {
    if (examined.edges.uses_of(e).size() != 1) continue;
    result.edges.push_back(static_cast<std::int32_t>(e));
    const auto [a, b] = examined.edges.ends[e];
    const double length = (examined.polygons.vertices[a] - examined.polygons.vertices[b]).norm();
    for (const std::int32_t v : {a, b}) {
      double& shortest = result.shortest_at[v];
      shortest = shortest == 0 ? length : std::min(shortest, length);
    }
  }
  return result;
}

class GapFinder {
 public:
  explicit GapFinder(const ExaminedScene& examined)
      : examined_(examined),
        boundary_(boundary_edges(examined)),
        tree_(edge_boxes()),
        findings_(examined.scene) {}

  std::vector<Finding> run() {
    const Vec3 reach = Vec3::Constant(kAlmostMeet * examined_.size);
    for (std::size_t v = 0; v < boundary_.shortest_at.size(); ++v) {
      if (boundary_.shortest_at[v] == 0) continue;
      const Vec3& p = examined_.polygons.vertices[v];
      tree_.for_each_meeting(Box3(p - reach, p + reach), [&](std::int32_t k) {
        compare(static_cast<std::int32_t>(v), boundary_.edges[k]);
      });
    }
    return findings_.take();
  }

 private:
  [[nodiscard]] std::vector<Box3> edge_boxes() const {
    std::vector<Box3> boxes;
    for (const std::int32_t e : boundary_.edges) {
      Box3 box(examined_.polygons.vertices[examined_.edges.ends[e][0]]);
      boxes.push_back(box.extend(examined_.polygons.vertices[examined_.edges.ends[e][1]]));
    }
    return boxes;
  }

  [[nodiscard]] Index polygon_of(std::int32_t edge) const {
    return examined_.edges.polygon_of_corner[examined_.edges.uses_of(edge)[0]];
  }

  [[nodiscard]] bool has_corner(Index polygon, std::int32_t vertex) const {
    const std::span<const std::int32_t> corners = examined_.polygons.polygon(polygon);
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  }

  void compare(std::int32_t vertex, std::int32_t edge);
  void compare_ends(std::int32_t vertex, std::int32_t end, std::int32_t edge);

  const ExaminedScene& examined_;
  BoundaryEdges boundary_;
  BoxTree tree_;
  FindingList findings_;
  std::set<std::pair<std::int32_t, std::int32_t>> reported_;
};

/// What there is to say about a boundary vertex near a boundary edge of a polygon that it is not a
/// corner of.
void GapFinder::compare(std::int32_t vertex, std::int32_t edge) {
  const auto [a, b] = examined_.edges.ends[edge];
  const Index polygon = polygon_of(edge);
  if (has_corner(polygon, vertex)) return;
  const Vec3& p = examined_.polygons.vertices[vertex];
  const Vec3& start = examined_.polygons.vertices[a];
  const Vec3 along = examined_.polygons.vertices[b] - start;
  const double length = along.norm();
  const double t = (p - start).dot(along) / (length * length);
  const double margin = kAlmostMeet * examined_.size / length;
  if (t <= margin) return compare_ends(vertex, a, edge);
  if (t >= 1 - margin) return compare_ends(vertex, b, edge);

  const double distance = (p - start - t * along).norm();
  const double limit = std::min(boundary_.shortest_at[vertex], length);
  if (distance <= std::max(kOnEdge * examined_.size, examined_.thickness)) {
    findings_.add(Finding::Kind::t_junction, Finding::Severity::note, polygon,
                  "a corner of another polygon at " + place(p) +
                      " lies in the middle of its edge; give it a corner there, or patches on "
                      "both sides will not fit");
  } else if (distance <= kAlmostMeet * examined_.size && distance <= kNarrow * limit) {
    findings_.add(Finding::Kind::gap, Finding::Severity::warning, polygon,
                  "its edge passes a corner of another polygon at " + place(p) + " at " +
                      number(distance) + " m; join them if they are meant to meet");
  }
}

void GapFinder::compare_ends(std::int32_t vertex, std::int32_t end, std::int32_t edge) {
  if (vertex >= end) return;  // each pair once
  const Vec3& p = examined_.polygons.vertices[vertex];
  const double distance = (p - examined_.polygons.vertices[end]).norm();
  const double limit = std::min(boundary_.shortest_at[vertex], boundary_.shortest_at[end]);
  if (distance <= examined_.thickness || distance > kAlmostMeet * examined_.size ||
      distance > kNarrow * limit) {
    return;
  }
  const bool is_rounding = distance < kSamePlace * examined_.size;
  if (!reported_.emplace(vertex, end).second) return;  // seen from another edge at `end`
  findings_.add(Finding::Kind::gap,
                is_rounding ? Finding::Severity::note : Finding::Severity::warning,
                polygon_of(edge),
                "its corner is " + number(distance) + " m off a corner of another polygon at " +
                    place(p) + "; give both the same coordinates if they are meant to meet");
}

}  // namespace

std::vector<Finding> find_gaps(const ExaminedScene& examined) { return GapFinder(examined).run(); }

}  // namespace meshing
