#pragma once

#include <string>
#include <vector>

#include "radiosity/scene/scene.h"

namespace meshing {

/// A scene whose polygons can all become patches, and what was wrong with it before.
struct CleanScene {
  radiosity::Scene scene;
  /// One line per kind of fault: how many polygons have it, which are the first, by their numbers
  /// in the scene given, and what was made of them. Empty if there was none.
  std::vector<std::string> repairs;
};

/// Leaves out polygons that enclose no area (fewer than three distinct corners, or all on one
/// line), whose outline crosses itself or has more than 10,000 corners, or that are the same as
/// another one, on the same side: of those one stays, which emits if any does. Keeps those that
/// repeat a corner, which then counts once, and edges at which more than two polygons of one
/// one-sided surface meet. The polygons that stay keep their order, and all surfaces, vertices and
/// materials stay. Vertices must be finite.
CleanScene leave_out_bad_polygons(radiosity::Scene scene);

}  // namespace meshing
