#pragma once

#include <vector>

#include "radiosity/geometry.h"
#include "radiosity/occluders.h"
#include "radiosity/patch_mesh.h"
#include "radiosity/shaft.h"

namespace radiosity {

/// A convex body that blocks light. A polygon is a body without thickness: two faces back to back.
struct Blocker {
  /// An edge, which runs counter-clockwise about the outward normal of the face on its left.
  struct Edge {
    Vec3 start;
    Vec3 end;
    int left;  ///< index of a face
    int right;
  };
  /// Bodies with more faces are left in polygons: every test loops over all of them.
  static constexpr std::size_t kMostFaces = 32;

  std::vector<HalfSpace> faces;  ///< outside is normal · x > offset
  std::vector<Edge> edges;
  std::vector<Vec3> corners;
  Box3 box;
  [[nodiscard]] bool is_flat() const { return faces.size() == 2; }
};

/// The occluders as blockers. One-sided occluders that meet edge to edge and bound a convex body
/// become one blocker, as do those that lack only a face in a plane with the whole scene on one
/// side, such as a box on the floor: nothing sees in through there. `thickness` is how far off a
/// plane points may be and still count as on it, m.
std::vector<Blocker> make_blockers(const std::vector<Occluder>& occluders, const PatchMesh& mesh,
                                   double thickness);

}  // namespace radiosity
