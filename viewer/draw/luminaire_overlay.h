#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Draws the scene's luminaires over the picture: a mark at each that is seen, its luminous opening
/// and where it aims; its polar curves if the look has them, and of the one that is chosen the
/// photometric solid. Needs an ImGui frame; `scale` is the size of text relative to a plain screen.
void draw_luminaires(const Desk& desk, double scale);

}  // namespace viewer
