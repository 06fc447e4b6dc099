#include "meshing/base/edge_table.h"

#include <algorithm>

namespace meshing {
namespace {

using radiosity::Index;

struct HalfEdge {
  std::int32_t far_end;  // the larger vertex index
  std::int64_t corner;
};

/// All half-edges bucketed by their smaller vertex index; offsets[v] is where bucket v starts.
struct Buckets {
  std::vector<HalfEdge> half_edges;
  std::vector<std::int64_t> offsets;
};

template <typename Visit>
void for_each_half_edge(const WeldedPolygons& polygons, const Visit& visit) {
  for (Index i = 0; i < polygons.size(); ++i) {
    const std::int64_t first = polygons.first_corner[i];
    const std::int64_t last = polygons.first_corner[i + 1];
    for (std::int64_t c = first; c < last; ++c) {
      const std::int32_t from = polygons.corners[c];
      const std::int32_t to = polygons.corners[c + 1 < last ? c + 1 : first];
      visit(i, c, std::min(from, to), std::max(from, to));
    }
  }
}

Buckets sort_by_ends(const WeldedPolygons& polygons) {
  Buckets result;
  result.offsets.assign(polygons.vertices.size() + 1, 0);
  result.half_edges.resize(polygons.corners.size());
  for_each_half_edge(polygons, [&](Index, std::int64_t, std::int32_t low, std::int32_t) {
    ++result.offsets[low + 1];
  });
  for (std::size_t v = 1; v < result.offsets.size(); ++v) {
    result.offsets[v] += result.offsets[v - 1];
  }
  std::vector<std::int64_t> next = result.offsets;
  for_each_half_edge(polygons,
                     [&](Index, std::int64_t corner, std::int32_t low, std::int32_t high) {
                       result.half_edges[next[low]++] = {high, corner};
                     });
  for (std::size_t v = 0; v + 1 < result.offsets.size(); ++v) {
    std::sort(result.half_edges.begin() + result.offsets[v],
              result.half_edges.begin() + result.offsets[v + 1],
              [](const HalfEdge& a, const HalfEdge& b) {
                return a.far_end != b.far_end ? a.far_end < b.far_end : a.corner < b.corner;
              });
  }
  return result;
}

}  // namespace

EdgeTable make_edge_table(const WeldedPolygons& polygons) {
  EdgeTable table;
  const Buckets buckets = sort_by_ends(polygons);
  table.edge_of_corner.resize(polygons.corners.size());
  table.polygon_of_corner.resize(polygons.corners.size());
  table.uses.reserve(polygons.corners.size());
  for (std::size_t v = 0; v + 1 < buckets.offsets.size(); ++v) {
    for (std::int64_t h = buckets.offsets[v]; h < buckets.offsets[v + 1]; ++h) {
      const std::array<std::int32_t, 2> ends{static_cast<std::int32_t>(v),
                                             buckets.half_edges[h].far_end};
      if (table.ends.empty() || table.ends.back() != ends) {
        table.ends.push_back(ends);
        table.first_use.push_back(h);
      }
      table.uses.push_back(buckets.half_edges[h].corner);
      table.edge_of_corner[buckets.half_edges[h].corner] =
          static_cast<std::int32_t>(table.ends.size()) - 1;
    }
  }
  table.first_use.push_back(static_cast<std::int64_t>(table.uses.size()));
  for_each_half_edge(polygons, [&](Index i, std::int64_t corner, std::int32_t, std::int32_t) {
    table.polygon_of_corner[corner] = static_cast<std::int32_t>(i);
  });
  return table;
}

std::vector<std::int32_t> non_manifold_polygons(const radiosity::Scene& scene,
                                                const EdgeTable& edges, Index e) {
  const std::span<const std::int64_t> uses = edges.uses_of(e);
  std::vector<std::int32_t> meeting;
  if (uses.size() < 3) return meeting;
  for (const std::int64_t use : uses) {
    const std::int32_t surface = scene.polygon_surface[edges.polygon_of_corner[use]];
    if (scene.surfaces[surface].two_sided) continue;
    meeting.clear();
    for (const std::int64_t other : uses) {
      const std::int32_t polygon = edges.polygon_of_corner[other];
      const bool is_new = std::find(meeting.begin(), meeting.end(), polygon) == meeting.end();
      if (scene.polygon_surface[polygon] == surface && is_new) meeting.push_back(polygon);
    }
    if (meeting.size() >= 3) return meeting;
  }
  meeting.clear();
  return meeting;
}

}  // namespace meshing
