#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// What solids cover of a mesh's patches: what lies on a solid's face and looks into it. Light
/// neither leaves nor reaches it.
struct Coverage {
  Eigen::VectorXd share;  ///< of each patch's area, n_patches, in [0, 1]
  /// Of the patches that are covered in part: what is left, in convex parts, relative to the centre
  /// of the mesh's box, m.
  std::map<std::int32_t, std::vector<ConvexPolygon>> open;

  /// Whether nothing of a patch is left but for rounding.
  [[nodiscard]] bool is_covered(std::int32_t patch) const { return share[patch] >= 1; }
};

/// Finds what is covered. Solids are closed outward-facing pieces of surface, and convex bodies
/// that stand on a plane which has the whole mesh on one side and lack only the face there. What a
/// solid turns towards the wall of the closed room that it stands in is covered, too. `thickness`
/// is how far off a plane points may be and still count as on it, m.
Coverage find_coverage(const PatchMesh& mesh, double thickness);

}  // namespace radiosity
