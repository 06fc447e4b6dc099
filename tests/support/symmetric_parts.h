#pragma once

#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/symmetry.h"

namespace radiosity::test {

/// Turns and moves everything, so that no plane or axis is along the coordinates.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();
  double scale = 1;
  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return scale * (turn * x) + shift; }
};

/// As it is, turned and moved, and far away and small.
std::vector<Placement> placements();

Symmetry placed(Symmetry symmetry, const Placement& placement);

/// The mesh as the part of a whole, placed.
PatchMesh part_of(const PatchMesh& mesh, const Symmetry& symmetry, const Placement& placement);

/// A plane through the origin.
Symmetry::Mirror mirror(const Vec3& normal);

Symmetry three_mirrors();

Symmetry folds_about_z(int folds);

/// The corner of a cube of side 2 about the origin that has all coordinates above 0, n x n quads a
/// face.
PatchMesh cube_corner(int n);

/// A sector of two concentric prisms of `folds` sides, the outer one facing inwards, with ends; n
/// quads along the axis on each.
PatchMesh prism_sector(int folds, double inner, double outer, double height, int n = 2);

/// A sector, above z = 0, of two concentric spheres of `folds` sides and n bands of latitude on the
/// half, the outer one facing inwards; surfaces 0 and 1.
PatchMesh sphere_sector(int folds, int n, double inner, double outer);

/// A period, along y, of a street between two walls, all 1 wide or high; n quads across each.
PatchMesh canyon_period(int n, double length);

}  // namespace radiosity::test
