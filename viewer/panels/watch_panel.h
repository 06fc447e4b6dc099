#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// The panel that records an iteration and steps through it.
class WatchPanel {
 public:
  /// Needs an ImGui window; `scale` is the size of text relative to a plain screen.
  void draw(Desk& desk, double scale);
  /// Whether the next step comes by itself.
  [[nodiscard]] bool is_playing() const { return is_playing_; }

 private:
  /// The step that is shown now, of those up to `last`.
  int next_step(int step, int last, bool is_complete);
  int draw_controls(int step, int last, int iteration);

  int method_ = 1;  // index into radiosity::all_methods
  bool is_playing_ = false;
  double next_step_ = 0;  // time at which the next step is shown, s
};

}  // namespace viewer
