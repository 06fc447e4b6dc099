#pragma once

#include <imgui.h>

#include <optional>

#include "viewer/desk/desk.h"

namespace viewer {

/// Where the colour bar stands in the window, pixels.
struct LegendBar {
  float left = 0;
  float top = 0;
  float width = 0;
  float height = 0;

  /// The place on the scale of a height in the window, beyond [0, 1] outside the bar.
  [[nodiscard]] double position(float y) const { return 1 - (y - top) / height; }
};

/// Empty if there is none, or no room for it. Needs an ImGui frame; `scale` is the size of text
/// relative to a plain screen.
std::optional<LegendBar> legend_bar(const Desk& desk, double scale);

/// Draws the desk's legend over the picture's right edge, always as wide, so that the picture stays
/// where it is.
void draw_legend(const Desk& desk, ImDrawList& list, double scale);

}  // namespace viewer
