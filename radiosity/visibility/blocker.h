#pragma once

#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity {

/// A convex body that blocks light. A polygon is a body without thickness: two faces back to back.
struct Blocker {
  /// An edge, which runs counter-clockwise about the outward normal of the face on its left.
  struct Edge {
    Vec3 start;
    Vec3 end;
    int left;  ///< index of a face
    int right;
  };
  /// Bodies with more faces are left in polygons, and polygons with more sides in parts.
  static constexpr std::size_t kMostFaces = 128;

  std::vector<HalfSpace> faces;  ///< outside is normal · x > offset
  std::vector<Edge> edges;
  std::vector<Vec3> corners;
  Box3 box;
  Vec3 center = Vec3::Zero();  ///< of a sphere that holds it
  double radius = 0;           ///< of that sphere, m
  /// Bodies of few faces, one each or none: what misses `outer` misses this blocker, what is all
  /// hidden by `inner`, with an end outside of `outer`, is hidden by it.
  std::vector<Blocker> outer;
  std::vector<Blocker> inner;
  [[nodiscard]] bool is_flat() const { return faces.size() == 2; }
};

/// Sets `center` and `radius` from the corners.
void set_sphere(Blocker& blocker);

}  // namespace radiosity
