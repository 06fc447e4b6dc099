#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/base/weld.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// The edges of welded polygons, each once however many polygons meet there. Corner c of a polygon
/// (an index into WeldedPolygons::corners) stands for the edge from that corner to the next one.
struct EdgeTable {
  std::vector<std::array<std::int32_t, 2>> ends;  ///< vertex indices, ends[e][0] < ends[e][1]
  std::vector<std::int64_t> first_use;            ///< n_edges + 1 offsets into `uses`
  std::vector<std::int64_t> uses;                 ///< corners that are edge e, increasing
  std::vector<std::int32_t> edge_of_corner;       ///< per corner
  std::vector<std::int32_t> polygon_of_corner;    ///< per corner

  [[nodiscard]] radiosity::Index size() const { return static_cast<radiosity::Index>(ends.size()); }
  /// The corners whose edge is e.
  [[nodiscard]] std::span<const std::int64_t> uses_of(radiosity::Index e) const {
    return std::span(uses).subspan(first_use[e], first_use[e + 1] - first_use[e]);
  }
};

/// Edges sorted by their ends.
EdgeTable make_edge_table(const WeldedPolygons& polygons);

/// Distinct polygons of one one-sided surface that meet at edge e, if they are three or more (of
/// the first such surface); otherwise none. Meeting polygons of different surfaces are fine.
std::vector<std::int32_t> non_manifold_polygons(const radiosity::Scene& scene,
                                                const EdgeTable& edges, radiosity::Index e);

}  // namespace meshing
