#pragma once

#include <array>

#include "radiosity/scene/scene.h"

namespace viewer {

/// An axis as the picture has it.
struct ShownAxis {
  char name = 'x';
  double right = 0;     ///< of its length, in the picture
  double up = 0;        ///< likewise
  double nearness = 0;  ///< likewise, towards the eye
};

/// The three axes of the scene as the camera sees them from afar, in the order in which they are
/// drawn: those that point away first.
std::array<ShownAxis, 3> shown_axes(const radiosity::Camera& camera);

}  // namespace viewer
