#pragma once

#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/visibility/blocker.h"

namespace radiosity {

/// The convex body that all half-spaces (of outward normals) hold, given points of which each
/// half-space touches one at least. Empty if it has no volume to speak of.
std::optional<Blocker> make_polytope(std::vector<HalfSpace> faces);

/// A body of at most 26 faces in fixed directions that just holds all points: a discrete
/// orientation polytope (Klosowski et al. 1998). Empty if they are (nearly) in a plane.
std::optional<Blocker> enclosing_polytope(std::span<const Vec3> points);

/// The same in a plane: a polygon of at most 12 sides around coplanar points.
std::optional<Blocker> enclosing_polygon(std::span<const Vec3> points, const HalfSpace& plane);

/// A body shrunk about a point inside by a factor a little below `most`, in (0, 1].
Blocker shrunk(const Blocker& body, const Vec3& about, double most);

}  // namespace radiosity
