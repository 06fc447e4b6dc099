#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Draws a line with how far the work is, what is known, what the mouse points at and, where there
/// is room, buttons for the messages below. Leaves out what would lie over something else. Needs an
/// ImGui window.
void draw_status_line(Desk& desk);

}  // namespace viewer
