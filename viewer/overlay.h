#pragma once

#include "viewer/desk.h"

namespace viewer {

/// Draws over the picture: the colour bar, the outline of the selected patch and of its strongest
/// partners, and what there is to say if there is no picture. `scale` is the size of text relative
/// to a plain screen. Needs an ImGui frame.
void draw_overlay(const Desk& desk, double scale);

}  // namespace viewer
