#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// A convex planar polygon that blocks light: one patch, or several in a plane merged.
struct Occluder {
  std::vector<Vec3> corners;  ///< counter-clockwise about `normal`, m
  Vec3 normal;                ///< unit
  double offset = 0;          ///< normal · x = offset on the plane, m
  Box3 box;
};

/// The patches merged into few convex polygons that cover exactly the same set, so that visibility
/// can be reasoned about at low cost. The patches of one input polygon are merged first, so that
/// the number of occluders depends little on how it is divided. `thickness` is how far off a plane
/// points may be and still count as on it, m.
std::vector<Occluder> make_occluders(const PatchMesh& mesh,
                                     const std::vector<std::int32_t>& patches, double thickness);

/// The occluders of one kind of patches, of which `kinds` has one number per patch, or of all if it
/// is empty; of each pair of twins one. None if there are no such patches.
std::vector<Occluder> occluders_of_kind(const PatchMesh& mesh, std::span<const int> kinds, int kind,
                                        double thickness);

/// Leaves out the occluders that lie within another one, such as one of two walls back to back.
void drop_covered_occluders(std::vector<Occluder>& occluders, double thickness);

}  // namespace radiosity
