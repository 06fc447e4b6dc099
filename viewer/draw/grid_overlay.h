#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Draws over the picture what of a scene's grids is no plane: the points of a list with their
/// values, if it is shown, and observers with where they look and their UGR. Needs an ImGui frame;
/// `scale` is the size of text relative to a plain screen.
void draw_grid_points(const Desk& desk, double scale);

}  // namespace viewer
