#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshing/base/edge_table.h"
#include "meshing/base/polygon_shape.h"
#include "radiosity/base/geometry.h"

namespace meshing {

/// How long pieces of edges may be, m, > 0 and possibly infinite. Where all edges at one limit are
/// too few patches and at a slightly smaller one too many, the first n_fine edges get the smaller.
struct EdgeLimit {
  double coarse = 0;
  double fine = 0;  ///< <= coarse
  radiosity::Index n_fine = 0;
};

/// Into how many equal pieces each edge is divided, the same for all polygons that share it.
struct EdgeDivision {
  double max_edge = 0;                 ///< m; infinite if nothing is to be divided
  std::vector<std::int32_t> n_pieces;  ///< per edge of the EdgeTable, >= 1
  std::vector<bool> is_grid;  ///< per polygon: a quad whose opposite edges have equally many pieces
};

/// Divides edges so that no piece, and no edge of a regular grid of pieces, is longer than the
/// limit. The counts of opposite edges of well-shaped quads are made
/// equal along strips of quads, as long as that does not make a quad more than twice as fine as it
/// would be alone; quads that this leaves without a grid are to be filled with triangles. Throws
/// MeshError if an edge would have more pieces than there can be patches.
EdgeDivision divide_edges(const WeldedPolygons& polygons, const EdgeTable& edges,
                          std::span<const PolygonKind> kinds, const EdgeLimit& limit);

}  // namespace meshing
