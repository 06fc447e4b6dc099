#pragma once

#include <vector>

#include "radiosity/patch_mesh.h"

namespace radiosity {

/// A convex planar polygon that blocks light: one patch, or several in a plane merged.
struct Occluder {
  std::vector<Vec3> corners;  ///< counter-clockwise about `normal`, m
  Vec3 normal;                ///< unit
  double offset = 0;          ///< normal · x = offset on the plane, m
  Box3 box;
  bool is_one_sided = false;  ///< every patch of it faces `normal` and has no twin
};

/// The patches merged into few convex polygons that cover exactly the same set, so that visibility
/// can be reasoned about at low cost. Polygons in a plane that has the whole scene on one side (a
/// wall of a convex room) are left out: they block nothing. `thickness` is how far off a plane
/// points may be and still count as on it, m.
std::vector<Occluder> make_occluders(const PatchMesh& mesh, double thickness);

}  // namespace radiosity
