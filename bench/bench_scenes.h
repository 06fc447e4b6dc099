#pragma once

#include "radiosity/patch_mesh.h"

namespace bench {

/// The unit cube with the box [.35,.65] x [.3,.6] x [.25,.75] inside; each wall of the cube in
/// `n_cells`² squares, each of the box in a quarter as many, of two triangles: 15 n_cells². m.
radiosity::PatchMesh box_in_box(long n_cells);

/// Streets between 6 x 6 buildings of different heights, open to the sky, in about `n_facets`
/// quads. m.
radiosity::PatchMesh street_canyon(long n_facets);

}  // namespace bench
