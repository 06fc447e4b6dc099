#pragma once

#include <vector>

#include "io/picture/rgb_picture.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/hidden_surfaces.h"
#include "viewer/desk/surface_line.h"

namespace viewer {

/// Surfaces that bend by less are curved, not creased, radian.
inline constexpr double kCreaseAngle = 0.35;
/// 8-bit sRGB: seen on dark and on light colours.
inline constexpr io::Rgb kOutlineColor = {165, 168, 172};

/// The lines by which a person recognises a scene in whatever colours: borders and creases of
/// surfaces and, of those that are curved, where they turn away from the camera. Patches that meet
/// at a T are joined if that halves an edge, as refinement does. Of surfaces that are not hidden.
std::vector<SurfaceLine> make_outlines(const radiosity::PatchMesh& mesh,
                                       const HiddenSurfaces& hidden = {});

}  // namespace viewer
