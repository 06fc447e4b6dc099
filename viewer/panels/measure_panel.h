#pragma once

#include "radiosity/picture/point_grid.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// The panel of work plane and light meter.
class MeasurePanel {
 public:
  /// Whether what was measured is to be saved. Needs an ImGui window.
  bool draw(Desk& desk);

 private:
  void draw_plane(Desk& desk);

  radiosity::WorkPlaneOptions typed_;  // as the fields have it
  bool is_typing_ = false;
};

}  // namespace viewer
