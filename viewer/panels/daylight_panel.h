#pragma once

#include "radiosity/scene/solar_position.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// Where the sun stands and what the sky is like, with what it takes to tell that by place and
/// time.
class DaylightPanel {
 public:
  /// Nothing for scenes without either. Needs an ImGui window.
  void draw(Desk& desk);

 private:
  void draw_time(Desk& desk);

  double latitude_ = 48;  // degrees
  double longitude_ = 11;
  int month_ = 6;
  int day_ = 21;
  double hour_ = 12;  // UTC
};

}  // namespace viewer
