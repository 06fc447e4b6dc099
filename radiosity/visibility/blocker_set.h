#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/blocker.h"

namespace radiosity {

/// Everything in a scene that blocks light, as convex blockers in a tree.
struct BlockerSet {
  /// A blocker, or several of them together.
  struct Node {
    Box3 box;
    std::int32_t blocker = -1;  ///< of a leaf
    std::int32_t left = -1;     ///< child nodes of the others
    std::int32_t right = -1;
    /// Around, and within, a piece of surface that is no convex body by itself: as in Blocker, one
    /// each or none.
    std::vector<Blocker> outer{};
    std::vector<Blocker> inner{};
    [[nodiscard]] bool is_leaf() const { return blocker >= 0; }
  };
  std::vector<Blocker> blockers;
  std::vector<Node> nodes;
  std::int32_t root = -1;  ///< -1: nothing blocks

  /// The blocker of a leaf.
  [[nodiscard]] const Blocker& blocker(std::int32_t node) const {
    return blockers[nodes[node].blocker];
  }
};

/// The patches of a mesh as blockers. One-sided pieces of surface that bound a convex body become
/// one blocker, as do those that lack only a face in a plane with the whole scene on one side, such
/// as a box on the floor: nothing sees in through there. The others become convex polygons.
/// `thickness` is how far off a plane points may be and still count as on it, m.
BlockerSet make_blockers(const PatchMesh& mesh, double thickness);

}  // namespace radiosity
