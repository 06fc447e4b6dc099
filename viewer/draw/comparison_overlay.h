#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Pinning::split as it is drawn, on a border between pixels.
double drawn_split(const Desk& desk);

/// Draws the line between pinned light and that of now, with a handle, and what was pinned. `scale`
/// is the size of text relative to a plain screen. Needs an ImGui frame.
void draw_comparison(const Desk& desk, double scale);

}  // namespace viewer
