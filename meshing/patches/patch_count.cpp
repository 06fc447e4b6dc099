#include "meshing/patches/patch_count.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshing {

using radiosity::Index;

PatchCount count_patches(const radiosity::Scene& scene, const Topology& topology,
                         const EdgeDivision& division) {
  // Filling puts points about 0.7 max_edge apart; a triangle then has 0.433 of that squared.
  const double triangle = 0.433 * std::pow(0.7 * division.max_edge, 2);
  PatchCount count;
  for (Index i = 0; i < topology.polygons.size(); ++i) {
    const std::int64_t first = topology.polygons.first_corner[i];
    const std::int64_t last = topology.polygons.first_corner[i + 1];
    double n_boundary = 0;
    std::int32_t most = 0;
    std::int32_t fewest = std::numeric_limits<std::int32_t>::max();
    for (std::int64_t c = first; c < last; ++c) {
      const std::int32_t n = division.n_pieces[topology.edges.edge_of_corner[c]];
      n_boundary += n;
      most = std::max(most, n);
      fewest = std::min(fewest, n);
    }
    const double sides = scene.surfaces[scene.polygon_surface[i]].two_sided ? 2 : 1;
    const bool is_planar_quad = topology.kinds[i] == PolygonKind::planar_quad;
    if (most == 1 && (last - first == 3 || is_planar_quad)) {
      count.certain += sides;
    } else if (division.is_grid[i]) {
      const double n = static_cast<double>(division.n_pieces[topology.edges.edge_of_corner[first]]);
      count.certain += sides * n * (n_boundary / 2 - n);
    } else if (last - first == 3 && most == fewest) {
      count.certain += sides * most * static_cast<double>(most);
    } else {
      count.estimated += sides * std::max(n_boundary - 2, topology.areas[i] / triangle);
    }
  }
  return count;
}

}  // namespace meshing
