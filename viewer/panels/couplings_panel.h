#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// How the surface that is asked about exchanges heat with others, and what it absorbs of the sun;
/// nothing for scenes of light. Needs an ImGui window.
void draw_couplings_panel(Desk& desk);

}  // namespace viewer
