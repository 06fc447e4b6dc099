#pragma once

#include "viewer/desk/desk.h"
#include "viewer/panels/panels.h"

namespace viewer {

/// What mouse and keyboard do over the picture. Needs an ImGui frame.
class Input {
 public:
  void handle(Desk& desk, Panels& panels);

 private:
  void handle_mouse(Desk& desk);
  static void handle_keys(Desk& desk, Panels& panels);
  static void fly(Desk& desk);

  bool is_dragging_ = false;  // a button went down over the picture
  double dragged_ = 0;        // pixels since then
};

}  // namespace viewer
