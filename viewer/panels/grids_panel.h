#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// What the scene's grids and observers ask for, and what was measured; nothing for a scene without
/// any. Needs an ImGui window.
void draw_grids_panel(Desk& desk);

}  // namespace viewer
