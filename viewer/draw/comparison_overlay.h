#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Draws the line between pinned light and that of now, with a handle, and what was pinned. `scale`
/// is the size of text relative to a plain screen. Needs an ImGui frame.
void draw_comparison(const Desk& desk, double scale);

}  // namespace viewer
