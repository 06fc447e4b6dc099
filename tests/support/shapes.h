#pragma once

#include <cstdint>
#include <random>
#include <span>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity::test {

/// Appends a parallelogram a + s u + t v, s, t in [0, 1], facing u x v, as nu x nv quads of a new
/// surface. Returns the index of the surface.
std::int32_t add_grid(PatchMesh& mesh, const Vec3& a, const Vec3& u, const Vec3& v, int nu, int nv);

enum class Facing { inwards, outwards };

/// Appends the six faces of a box, n x n quads each: -z, +z, -x, +x, -y, +y.
void add_box(PatchMesh& mesh, const Vec3& low, const Vec3& high, int n, Facing facing);

/// The unit cube seen from inside, n_walls x n_walls quads a face, and in it the box
/// [.35,.65] x [.3,.6] x [.25,.75], n_box x n_box quads a face.
PatchMesh box_in_box(int n_walls, int n_box);

/// A direction, all alike.
Vec3 random_unit(std::mt19937_64& random);

/// A point of the hull of some corners, each of them near at times.
Vec3 random_point(std::span<const Vec3> corners, std::mt19937_64& random);

/// The share of a segment that lies inside a convex body, by cutting it with all half-spaces.
double length_inside(std::span<const HalfSpace> faces, const Vec3& from, const Vec3& to);

/// Adds the back side of every patch of a surface.
void make_two_sided(PatchMesh& mesh, std::int32_t surface);

}  // namespace radiosity::test
