#pragma once

#include <optional>
#include <span>

#include "viewer/desk/desk.h"
#include "viewer/desk/key_press.h"
#include "viewer/desk/shown_scale.h"
#include "viewer/panels/panels.h"

namespace viewer {

/// What mouse and keyboard do over the picture. Needs an ImGui frame.
class Input {
 public:
  /// `keys` are those that were pressed since the last call; `scale` is the size of text relative
  /// to a plain screen.
  void handle(Desk& desk, Panels& panels, std::span<const KeyPress> keys, double scale);

 private:
  void handle_mouse(Desk& desk, double scale);
  bool drag_split(Desk& desk, double x, bool is_over);
  /// Whether the mouse is on the colour bar, or drags an end of it.
  bool handle_legend(Desk& desk, double scale);
  static void press(Desk& desk, Panels& panels, const KeyPress& key);
  static void fly(Desk& desk, std::span<const KeyPress> keys);

  /// An end of the colour bar in the mouse's hand, and the scale as it was.
  struct HeldEnd {
    BarEnd end = BarEnd::high;
    io::ColorScale scale;
  };
  std::optional<HeldEnd> held_end_;
  bool is_splitting_ = false;  // a button went down over the line beside pinned light
  bool is_dragging_ = false;   // or over the picture
  radiosity::Vec3 grabbed_ = radiosity::Vec3::Zero();  // the point where that was, m
  double dragged_ = 0;                                 // pixels since then
};

}  // namespace viewer
