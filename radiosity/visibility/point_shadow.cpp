#include "radiosity/visibility/point_shadow.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace radiosity {
namespace {

struct Range {
  double low;
  double high;
};

/// How far in front of a plane points are.
Range range_over(std::span<const Vec3> points, const HalfSpace& plane) {
  Range range{1e300, -1e300};
  for (const Vec3& point : points) {
    const double height = plane.normal.dot(point) - plane.offset;
    range.low = std::min(range.low, height);
    range.high = std::max(range.high, height);
  }
  return range;
}

}  // namespace

Blocking add_point_shadow(const Blocker& blocker, const Vec3& point, std::span<const Vec3> target,
                          double thickness, Shadow& shadow) {
  assert(blocker.faces.size() <= Blocker::kMostFaces);
  std::array<double, Blocker::kMostFaces> height;
  bool is_outside = false;
  bool is_on_face = false;
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    height[f] = blocker.faces[f].normal.dot(point) - blocker.faces[f].offset;
    is_outside |= height[f] > thickness;
    is_on_face |= std::abs(height[f]) <= thickness;
  }
  if (!is_outside && blocker.is_flat()) return Blocking::none;  // seen edge-on
  if (!is_outside && !is_on_face) return Blocking::all;
  // From a point on the surface, all is hidden that lies behind every face that it is on.
  const std::size_t n_faces = shadow.faces.size();
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    const bool is_seen = is_outside ? height[f] > thickness : std::abs(height[f]) <= thickness;
    if (!is_seen) continue;
    const Range there = range_over(target, blocker.faces[f]);
    if (there.low >= -thickness) {  // the target is in front of the face, or on it
      shadow.faces.resize(n_faces);
      return Blocking::none;
    }
    if (there.high > thickness) shadow.faces.push_back(blocker.faces[f]);
  }
  if (!is_outside) return shadow.faces.size() > n_faces ? Blocking::some : Blocking::all;
  for (const Blocker::Edge& edge : blocker.edges) {
    const bool left = height[edge.left] > thickness;
    const bool right = height[edge.right] > thickness;
    if (left == right) continue;
    shadow.edges.push_back(left ? Shadow::Edge{edge.start, edge.end}
                                : Shadow::Edge{edge.end, edge.start});
  }
  return Blocking::some;
}

}  // namespace radiosity
