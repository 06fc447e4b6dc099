#pragma once

#include "viewer/desk/desk.h"
#include "viewer/desk/picture_plan.h"

namespace viewer {

/// What is to be said over the picture now. Refers to the desk's legend.
PictureWords picture_words(const Desk& desk);

/// Pinning::split as it is drawn, on a border between pixels.
double drawn_split(const Desk& desk);

}  // namespace viewer
