#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Width of the strip at the right of the picture that the colour bar takes, pixels; 0 if there is
/// none. Needs an ImGui frame.
float legend_width(const Desk& desk, double scale);

/// Draws the colour bar beside the picture, and over it the outline of the selected patch and of
/// its strongest partners, and what there is to say if there is no picture. `scale` is the size of
/// text relative to a plain screen. Needs an ImGui frame.
void draw_overlay(const Desk& desk, double scale);

}  // namespace viewer
