#include "meshing/base/outline.h"

#include <algorithm>

#include "meshing/base/triangulate.h"

namespace meshing {

using radiosity::Vec3;

Outline outline(std::span<const std::int32_t> polygon) {
  Outline result;
  const auto rotate_to_smallest = [](std::vector<std::int32_t>& c) {
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  };
  result.corners.assign(polygon.begin(), polygon.end());
  std::vector<std::int32_t> backwards(polygon.rbegin(), polygon.rend());
  rotate_to_smallest(result.corners);
  rotate_to_smallest(backwards);
  result.reversed = backwards < result.corners;
  if (result.reversed) result.corners.swap(backwards);
  return result;
}

bool has_crossing_outline(PolygonKind kind, std::span<const Vec3> points) {
  if (kind == PolygonKind::self_crossing) return true;
  if (kind != PolygonKind::planar_polygon && kind != PolygonKind::non_planar_polygon) return false;
  const PlaneFrame frame(points);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.push_back(frame.to_plane(p));
  return !clip_ears(flat).has_value();
}

}  // namespace meshing
