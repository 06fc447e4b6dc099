#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// The panel that records an iteration and steps through it.
class WatchPanel {
 public:
  /// Needs an ImGui window; `scale` is the size of text relative to a plain screen.
  void draw(Desk& desk, double scale);
  /// How high it was when it was drawn last, with what is around it in a window of its own, pixels.
  [[nodiscard]] float height() const { return height_; }

 private:
  void draw_record(Desk& desk, const IterationRecord& record, double scale);

  float height_ = 0;
};

}  // namespace viewer
