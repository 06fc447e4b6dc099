#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// One-sided facets (patches, or the polygons that they are parts of) that hang together at their
/// edges.
struct SurfacePiece {
  std::vector<std::int32_t> facets;
  std::vector<std::int32_t> open_edges;  ///< half-edges without a neighbour; none: closed
  double volume = 0;  ///< enclosed, if closed, m³: > 0 where the facets face outwards; 0 if it is
                      ///< no more than the thickness makes
  [[nodiscard]] bool is_solid() const { return open_edges.empty() && volume > 0; }
  /// Such as the walls of a room.
  [[nodiscard]] bool is_hollow() const { return open_edges.empty() && volume < 0; }
};

/// A half-edge runs from a corner of a facet to the next, counter-clockwise about its normal, and
/// goes by the number of that corner in `corners`.
struct SurfacePieces {
  std::vector<Vec3> corners;               ///< of all facets, concatenated, m
  std::vector<std::int32_t> first_corner;  ///< n_facets + 1 offsets into `corners`
  std::vector<std::int32_t> facet;         ///< per half-edge
  std::vector<std::int32_t> neighbor;      ///< per half-edge: the half-edge that runs back, or -1
  std::vector<Vec3> normal;                ///< per facet, unit
  std::vector<SurfacePiece> pieces;

  [[nodiscard]] std::int32_t next(std::int32_t half_edge) const {
    const std::int32_t f = facet[half_edge];
    return half_edge + 1 < first_corner[f + 1] ? half_edge + 1 : first_corner[f];
  }
  [[nodiscard]] std::span<const Vec3> outline(std::int32_t f) const {
    return std::span(corners).subspan(first_corner[f], first_corner[f + 1] - first_corner[f]);
  }
};

/// Joins the given one-sided patches of a mesh where edges run opposite ways between the same
/// points; an edge that has ends of others within is several. Where more than two facets meet at an
/// edge (solids that touch), those are joined that have matter between them and nothing else.
/// `thickness` is how far off points may be, m.
SurfacePieces find_surface_pieces(const PatchMesh& mesh, const std::vector<std::int32_t>& patches,
                                  double thickness);

}  // namespace radiosity
