#include <algorithm>

#include "meshing/base/text.h"
#include "meshing/inspect/findings.h"

namespace meshing {

using radiosity::Index;

std::vector<Finding> find_non_manifold_edges(const ExaminedScene& examined) {
  FindingList findings(examined.scene);
  const EdgeTable& edges = examined.edges;
  for (Index e = 0; e < edges.size(); ++e) {
    const std::vector<std::int32_t> meeting = non_manifold_polygons(examined.scene, edges, e);
    if (meeting.empty()) continue;
    findings.add(Finding::Kind::non_manifold_edge, Finding::Severity::warning, meeting[0],
                 std::to_string(meeting.size()) +
                     " polygons of the surface meet at its edge from " +
                     place(examined.polygons.vertices[edges.ends[e][0]]) + " to " +
                     place(examined.polygons.vertices[edges.ends[e][1]]) +
                     "; put them in separate surfaces if that is meant");
  }
  return findings.take();
}

Closure examine_closure(const ExaminedScene& examined) {
  const EdgeTable& edges = examined.edges;
  Closure closure;
  bool found_one_sided = false;
  bool all_shared_by_two = true;
  for (Index e = 0; e < edges.size(); ++e) {
    const std::span<const std::int64_t> uses = edges.uses_of(e);
    const auto n = std::count_if(uses.begin(), uses.end(), [&](std::int64_t corner) {
      return !examined.is_two_sided(edges.polygon_of_corner[corner]);
    });
    if (n == 0) continue;
    found_one_sided = true;
    if (n == 1) ++closure.n_boundary_edges;
    if (n != 2) all_shared_by_two = false;
  }
  closure.closed = found_one_sided && all_shared_by_two;
  return closure;
}

}  // namespace meshing
