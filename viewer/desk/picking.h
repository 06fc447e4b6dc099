#pragma once

#include <optional>

#include "radiosity/base/geometry.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// The point, m, of a surface that is seen at a place of the picture, x and y in [0, 1] from its
/// top left; that of a corner of its patch if that is some pixels away.
std::optional<radiosity::Vec3> point_at(const Desk& desk, double x, double y);

/// The same, not drawn to corners; if nothing is there, a point as far away as the camera's pivot.
radiosity::Vec3 point_towards(const Desk& desk, double x, double y);

}  // namespace viewer
