#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "radiosity/base/box_tree.h"
#include "radiosity/visibility/edge_spokes.h"

namespace radiosity {

/// What patches make of the borders of free space where they touch.
struct BorderJoints {
  SideJoints sides;  ///< that face each other about an edge, or may
  /// Patches that lie on each other, each pair once.
  std::vector<std::pair<std::int32_t, std::int32_t>> overlaps;
};

/// Goes around all edges of the mesh's patches, a group of them after the other. What is closer
/// than `reach`, m, touches; `tree` is of the patches' boxes, grown by it, which are `boxes`.
std::vector<BorderJoints> find_border_joints(const PatchMesh& mesh, double reach,
                                             const BoxTree& tree, const std::vector<Box3>& boxes);

}  // namespace radiosity
