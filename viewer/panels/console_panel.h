#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// The messages below the picture, and how much room they have.
class ConsolePanel {
 public:
  /// Height that they ask for, pixels, without the line above them.
  [[nodiscard]] static float height(const Desk& desk, double scale);
  /// Lets the mouse drag the upper edge of the window that they are drawn in. Needs that ImGui
  /// window, as the next one.
  static void draw_edge(Desk& desk);
  /// Buttons at the right end of a line of that window.
  static void draw_buttons(Desk& desk);
  /// Pixels that they take.
  static float buttons_width();
  /// The messages, in the rest of it: old ones pale, of a file that is not open any more.
  void draw(Desk& desk);

 private:
  int length_ = 0;  // Session::Versions::messages when it was drawn last
};

}  // namespace viewer
