#pragma once

#include <cstdint>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// What lies within the picture of a camera, whether hidden by something else or not.
struct ViewContent {
  bool fronts = false;  ///< the emitting side of some patch; without one the picture is empty
  bool backs = false;   ///< the back of some patch, which a picture does not show
};

/// Exact but for rounding, without rays. `aspect` is the picture's width / height.
ViewContent view_content(const PatchMesh& mesh, const Camera& camera, double aspect);

/// How far a point is surrounded by backs.
struct Surroundings {
  double backs = 0;           ///< share of all directions in which a back is met first, in [0, 1]
  std::int32_t nearest = -1;  ///< patch of the nearest one; -1: none is met
};

/// Looks into 1024 directions, evenly spread over the sphere. Inside a solid or a wall all of them
/// meet backs first, but for its openings; outside a convex room that one looks into at most half
/// of them do.
Surroundings surroundings(const Visibility& visibility, const Vec3& point);

}  // namespace radiosity
