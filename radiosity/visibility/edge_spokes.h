#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/visibility/patch_sides.h"

namespace radiosity {

/// A patch at an edge, seen along it.
struct Spoke {
  std::int32_t patch;
  double angle;            ///< about the edge, radian
  double slack;            ///< by which its angle may be off
  bool front_is_forwards;  ///< whether its front faces growing angles
};

/// Sides of patches to join, by their numbers in PatchSides.
using SideJoints = std::vector<std::pair<Index, Index>>;

/// All sides of two patches.
void join_all(const PatchSides& sides, std::int32_t i, std::int32_t j, SideJoints& joints);

/// Joins what faces each other about an edge: the spokes, in the order of their angles, in stacks
/// of those that are one to the digits, as sheets back to back. Of the patches in a stack those
/// that face a neighbouring stack cover the backs of the others; where none does the backs are
/// free. What is too slender for its angle to tell is joined on all sides.
void join_in_turn(const PatchSides& sides, std::span<const Spoke> spokes, SideJoints& joints);

}  // namespace radiosity
