#pragma once

#include <imgui.h>

#include "viewer/desk/legend.h"
#include "viewer/desk/picture_plan.h"

namespace viewer {

/// Draws a colour bar with its words where it was planned, always as wide, so that the picture
/// stays where it is. Needs an ImGui frame; `scale` is the size of text relative to a plain screen.
void draw_legend(const Legend& legend, const LegendPlan& plan, ImDrawList& list, float scale);

}  // namespace viewer
