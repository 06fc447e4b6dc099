#pragma once

#include "viewer/desk/desk.h"

namespace viewer {

/// Makes the surface that is asked about a lamp of so many lumens.
class LampMaker {
 public:
  /// Nothing unless a patch of a scene of light is asked. Needs an ImGui window.
  void draw(Desk& desk);

 private:
  double lumens_ = 1000;
};

}  // namespace viewer
