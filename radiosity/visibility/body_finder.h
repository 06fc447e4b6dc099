#pragma once

#include <optional>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/surface_pieces.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/outer_planes.h"

namespace radiosity {

/// The convex body that a piece of surface bounds, if it does.
struct FoundBody {
  Blocker blocker;
  /// Corners of the face that the piece lacks, if any, facing outwards.
  std::vector<Vec3> cap;
};

/// Makes a body of a piece that is closed and faces outwards, or whose open edges lie in one plane
/// that has the whole mesh behind, whose `vertices` are given. `thickness` is how far off a plane
/// points may be, m.
std::optional<FoundBody> find_body(const SurfacePieces& pieces, const SurfacePiece& piece,
                                   const VertexBlocks& vertices, double thickness);

/// A body of few faces within a closed solid, shrunk from one around it; empty if there is none of
/// a size worth the while.
std::optional<Blocker> find_inner_body(const SurfacePieces& pieces, const SurfacePiece& piece,
                                       const Blocker& outer);

}  // namespace radiosity
