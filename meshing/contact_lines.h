#pragma once

#include <array>
#include <vector>

#include "radiosity/patch_mesh.h"

namespace meshing {

/// A straight line from [0] to [1], m.
using Segment = std::array<radiosity::Vec3, 2>;

/// Where other patches stand on a patch or pass through it, and what lies behind them is shut off
/// from the light: for each patch the segments, within it and in its plane, in which others that
/// reach in front of it meet its plane. There the radiosity jumps (a discontinuity of degree 0;
/// Lischinski, Tampieri & Greenberg 1992). Segments along its own edges are left out.
std::vector<std::vector<Segment>> contact_lines(const radiosity::PatchMesh& mesh);

}  // namespace meshing
