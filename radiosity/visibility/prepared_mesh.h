#pragma once

#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/blocker_set.h"
#include "radiosity/visibility/cluster_tree.h"

namespace radiosity {

/// What proofs and kernels need of a mesh. Coordinates are relative to the centre of its box, to
/// keep digits when the scene lies far from the origin.
struct PreparedMesh {
  /// With several parts the mesh is so many images of its first patches, and so is the tree.
  explicit PreparedMesh(const PatchMesh& mesh, Index n_parts = 1);

  [[nodiscard]] Index size() const { return static_cast<Index>(polygons.size()); }

  Vec3 center;       ///< of the mesh's box, m
  double thickness;  ///< how far off a plane a point may be and still count as on it, m
  std::vector<HalfSpace> planes;  ///< of the patches; in front is normal · x > offset
  /// The patches; corners off their plane by more than the thickness are put back onto it, for a
  /// quad that is planar only to a file's digits would lie in its own shadow.
  std::vector<ConvexPolygon> polygons;
  std::vector<Disc> discs;  ///< around them
  ClusterTree tree;
  BlockerSet blockers;
};

}  // namespace radiosity
