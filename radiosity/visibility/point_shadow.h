#pragma once

#include <span>

#include "radiosity/base/geometry.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/segment_bundle.h"

namespace radiosity {

/// Appends to `shadow` what a blocker hides of a convex target from a single point, which may lie
/// on it: half-spaces that hold the whole target are left out, and the target is on no face that
/// the shadow is behind of. Returns `some`; or `none` or `all`, with `shadow` as it was, if it
/// hides nothing or, with the point inside or on it, everything. `thickness` is how far off a plane
/// a point may be and still count as on it, m.
Blocking add_point_shadow(const Blocker& blocker, const Vec3& point, std::span<const Vec3> target,
                          double thickness, Shadow& shadow);

}  // namespace radiosity
