#pragma once

#include <cstdint>

#include "radiosity/scene/patch_mesh.h"

namespace bench {

/// The unit cube with the box [.35,.65] x [.3,.6] x [.25,.75] inside; each wall of the cube in
/// `n_cells`² squares, each of the box in a quarter as many, of two triangles: 15 n_cells². m.
radiosity::PatchMesh box_in_box(long n_cells);

/// Streets between 6 x 6 buildings of different heights, open to the sky, in about `n_facets`
/// quads. m.
radiosity::PatchMesh street_canyon(long n_facets);

/// Two turned boxes in a room, `n_patches` quads and triangles or, if 0, each polygon as it is;
/// with coordinates of so many significant digits. m.
radiosity::PatchMesh turned_boxes(long n_patches, int digits);

/// 80 separate turned boxes in a room, about `n_patches` patches. m.
radiosity::PatchMesh many_boxes(long n_patches);

/// Two spheres of 1,280 triangles each in a box, about `n_patches` patches. m.
radiosity::PatchMesh spheres(long n_patches);

/// A closed mesh with bumps, of 5,120 triangles, in a box with a lamp of its own; about `n_patches`
/// patches, though no fewer than that. m.
radiosity::PatchMesh bumpy_mesh(long n_patches);

/// Two rooms of one size with a box in each, back to back on either side of a plane, or, with
/// `n_rooms` 1, one of them; about `n_patches` patches a room. m.
radiosity::PatchMesh rooms(long n_patches, int n_rooms);

/// Three plates of so many sides, one above the other, about `n_patches` patches. m.
radiosity::PatchMesh plates(long n_patches, int n_sides);

/// A closed room of 60 to 200 polygons: boxes, turned anyhow or standing on the floor, prisms and
/// thin plates, none of which meet; about `n_patches` patches. m.
radiosity::PatchMesh cluttered_room(std::uint64_t seed, long n_patches);

}  // namespace bench
