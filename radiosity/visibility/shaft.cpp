#include "radiosity/visibility/shaft.h"

#include <algorithm>

namespace radiosity {
namespace {

/// Highest and lowest value of normal · x over a box.
std::pair<double, double> range_over(const Box3& box, const Vec3& normal) {
  const double middle = normal.dot(box.center());
  const double reach = 0.5 * normal.cwiseAbs().dot(box.sizes());
  return {middle - reach, middle + reach};
}

}  // namespace

BoxShaft::BoxShaft(const Box3& a, const Box3& b) : both_(a.merged(b)) {
  // In the projection along each axis, lines that join corners of the two rectangles and leave
  // both on one side.
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int corner_a = 0; corner_a < 4; ++corner_a) {
      const bool high_u = (corner_a & 1) != 0;
      const bool high_v = (corner_a & 2) != 0;
      // Only corners that point the same way in both rectangles can be joined by such a line.
      const double au = high_u ? a.max()[u] : a.min()[u];
      const double av = high_v ? a.max()[v] : a.min()[v];
      const double bu = high_u ? b.max()[u] : b.min()[u];
      const double bv = high_v ? b.max()[v] : b.min()[v];
      Vec3 normal = Vec3::Zero();
      normal[u] = bv - av;
      normal[v] = au - bu;
      const double length = normal.norm();
      if (length == 0) continue;
      normal /= length;
      if (normal[u] * (high_u ? 1 : -1) < 0) normal = -normal;
      if (normal[u] * (high_u ? 1 : -1) < 0 || normal[v] * (high_v ? 1 : -1) < 0) continue;
      const double offset = std::max(range_over(a, normal).second, range_over(b, normal).second);
      planes_.push_back({normal, offset});
    }
  }
}

bool BoxShaft::misses(const Box3& box, std::span<const Vec3> corners, double thickness) const {
  if ((box.min().array() >= both_.max().array() - thickness).any() ||
      (both_.min().array() >= box.max().array() - thickness).any()) {
    return true;
  }
  return std::any_of(planes_.begin(), planes_.end(), [&](const HalfSpace& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
      return plane.normal.dot(corner) >= plane.offset - thickness;
    });
  });
}

bool BoxShaft::misses(const Box3& box, double thickness) const {
  if ((box.min().array() >= both_.max().array() - thickness).any() ||
      (both_.min().array() >= box.max().array() - thickness).any()) {
    return true;
  }
  return std::any_of(planes_.begin(), planes_.end(), [&](const HalfSpace& plane) {
    return range_over(box, plane.normal).first >= plane.offset - thickness;
  });
}

}  // namespace radiosity
