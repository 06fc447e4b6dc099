#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Draws over the picture how far it can be trusted, the outline of the selected patch and of its
/// strongest partners where they are seen, the colour bar at the right edge, and what there is to
/// say if there is no picture. `scale` is the size of text relative to a plain screen. Needs an
/// ImGui frame.
void draw_overlay(const Desk& desk, double scale);

}  // namespace viewer
