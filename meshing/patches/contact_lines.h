#pragma once

#include <array>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace meshing {

/// A straight line from [0] to [1], m.
using Segment = std::array<radiosity::Vec3, 2>;

/// Where other patches stand on a patch or pass through it, and what lies behind them is shut off
/// from the light: for each patch the segments, within it and in its plane, in which others that
/// reach in front of it meet its plane. There the radiosity jumps (a discontinuity of degree 0;
/// Lischinski, Tampieri & Greenberg 1992). What is closer to a plane than `plane_thickness` touches
/// it. Segments along the patch's own edges are left out.
std::vector<std::vector<Segment>> contact_lines(const radiosity::PatchMesh& mesh);

/// The same of the input polygons, whose patches are given as they are (`--as-is`) with
/// `polygon_corners`: for each polygon. Left out are segments along its outline only, not those
/// along edges of the triangles that it is made of.
std::vector<std::vector<Segment>> polygon_contact_lines(const radiosity::PatchMesh& as_is);

/// The patches that others stand on or pass through further from their edges than a share of 1e-5
/// of their size, in increasing order: light may leak from one of their parts into the other.
std::vector<radiosity::Index> crossed_patches(const radiosity::PatchMesh& mesh);

}  // namespace meshing
