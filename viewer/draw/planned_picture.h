#pragma once

#include <imgui.h>

#include "viewer/desk/desk.h"
#include "viewer/desk/picture_plan.h"

namespace viewer {

/// What lies where over the picture now. Needs an ImGui frame; `scale` is the size of text relative
/// to a plain screen.
PicturePlan planned_picture(const Desk& desk, double scale);

/// Draws a text on its plate.
void draw_plate(ImDrawList& list, const Box& box, ImU32 ink, const std::string& text, float scale);

}  // namespace viewer
