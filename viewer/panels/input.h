#pragma once

#include <span>

#include "viewer/desk/desk.h"
#include "viewer/desk/key_press.h"
#include "viewer/panels/panels.h"

namespace viewer {

/// What mouse and keyboard do over the picture. Needs an ImGui frame.
class Input {
 public:
  /// `keys` are those that were pressed since the last call.
  void handle(Desk& desk, Panels& panels, std::span<const KeyPress> keys);

 private:
  void handle_mouse(Desk& desk);
  bool drag_split(Desk& desk, double x, bool is_over);
  static void press(Desk& desk, Panels& panels, const KeyPress& key);
  static void fly(Desk& desk, std::span<const KeyPress> keys);

  bool is_splitting_ = false;  // a button went down over the line beside pinned light
  bool is_dragging_ = false;   // or over the picture
  double dragged_ = 0;         // pixels since then
};

}  // namespace viewer
