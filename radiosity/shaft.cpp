#include "radiosity/shaft.h"

#include <algorithm>

namespace radiosity {
namespace {

/// Highest and lowest value of normal · x over a box.
std::pair<double, double> range_over(const Box3& box, const Vec3& normal) {
  const double middle = normal.dot(box.center());
  const double reach = 0.5 * normal.cwiseAbs().dot(box.sizes());
  return {middle - reach, middle + reach};
}

std::pair<double, double> range_over(std::span<const Vec3> points, const Vec3& normal) {
  std::pair<double, double> range{1e300, -1e300};
  for (const Vec3& point : points) {
    const double height = normal.dot(point);
    range.first = std::min(range.first, height);
    range.second = std::max(range.second, height);
  }
  return range;
}

bool is_outside(const Occluder& occluder, const HalfSpace& plane, double thickness) {
  return std::all_of(occluder.corners.begin(), occluder.corners.end(), [&](const Vec3& corner) {
    return plane.normal.dot(corner) >= plane.offset - thickness;
  });
}

bool boxes_are_apart(const Box3& a, const Box3& b, double thickness) {
  return (a.min().array() >= b.max().array() - thickness).any() ||
         (b.min().array() >= a.max().array() - thickness).any();
}

/// Whether the point, known to lie in the occluder's plane, is within it.
bool contains(const Occluder& occluder, const Vec3& point, double thickness) {
  const std::size_t n = occluder.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3& corner = occluder.corners[k];
    const Vec3 edge = occluder.corners[k + 1 < n ? k + 1 : 0] - corner;
    if (occluder.normal.dot(edge.cross(point - corner)) < -thickness * edge.norm()) return false;
  }
  return true;
}

/// Whether every segment between the two sets of points, which lie on different sides of the
/// occluder's plane, passes through it. The crossings of a convex set's segments are the hull of
/// those between its corners, and the occluder is convex.
bool cuts_all(const Occluder& occluder, std::span<const Vec3> a, std::span<const Vec3> b) {
  for (const Vec3& p : a) {
    const double height_p = occluder.normal.dot(p) - occluder.offset;
    for (const Vec3& q : b) {
      const double height_q = occluder.normal.dot(q) - occluder.offset;
      if (height_p == height_q) continue;  // both on the plane: their other segments tell
      const Vec3 crossing = p + height_p / (height_p - height_q) * (q - p);
      if (!contains(occluder, crossing, 0)) return false;
    }
  }
  return true;
}

std::array<Vec3, 8> corners_of(const Box3& box) {
  std::array<Vec3, 8> corners;
  for (int k = 0; k < 8; ++k) corners[k] = box.corner(static_cast<Box3::CornerType>(k));
  return corners;
}

}  // namespace

BoxShaft::BoxShaft(const Box3& a, const Box3& b) : a_(a), b_(b), both_(a.merged(b)) {
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

Blocking BoxShaft::test(const Occluder& occluder, double thickness) const {
  if (boxes_are_apart(occluder.box, both_, thickness)) return Blocking::none;
  const auto [low_a, high_a] = range_over(a_, occluder.normal);
  const auto [low_b, high_b] = range_over(b_, occluder.normal);
  if (std::min(low_a, low_b) >= occluder.offset - thickness ||
      std::max(high_a, high_b) <= occluder.offset + thickness) {
    return Blocking::none;
  }
  for (const HalfSpace& plane : planes_) {
    if (is_outside(occluder, plane, thickness)) return Blocking::none;
  }
  const double above = occluder.offset + thickness;
  const double below = occluder.offset - thickness;
  const bool is_between = (low_a > above && high_b < below) || (low_b > above && high_a < below);
  if (is_between && cuts_all(occluder, corners_of(a_), corners_of(b_))) return Blocking::all;
  return Blocking::some;
}

PolygonShaft::PolygonShaft(const ConvexPolygon& a, const HalfSpace& plane_a, const ConvexPolygon& b,
                           const HalfSpace& plane_b, double thickness)
    : a_(a), b_(b), thickness_(thickness) {
  for (const Vec3& point : a) box_.extend(point);
  for (const Vec3& point : b) box_.extend(point);
  // Segments stay in front of both polygons.
  planes_[n_planes_++] = {-plane_a.normal, -plane_a.offset};
  planes_[n_planes_++] = {-plane_b.normal, -plane_b.offset};
  add_supporting_planes(a, b);
  add_supporting_planes(b, a);
}

void PolygonShaft::add_supporting_planes(const ConvexPolygon& p, const ConvexPolygon& q) {
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Vec3& start = p[k];
    const Vec3 edge = p[k + 1 < p.size() ? k + 1 : 0] - start;
    // Turn the plane through the edge until it touches q with all of q on the inner side: it then
    // holds the corner of q that no other corner exceeds.
    for (const Vec3& corner : q) {
      Vec3 normal = edge.cross(corner - start);
      const double length = normal.norm();
      if (length <= 1e-12 * edge.norm() * edge.norm()) continue;
      normal /= length;
      const double offset = normal.dot(start);
      auto [low, high] = range_over(p.points(), normal);
      if (high - low <= thickness_) continue;  // the plane of p itself, not a side of the hull
      const auto [low_q, high_q] = range_over(q.points(), normal);
      low = std::min(low, low_q);
      high = std::max(high, high_q);
      if (high <= offset + thickness_) {
        planes_[n_planes_++] = {normal, high};
        break;
      }
      if (low >= offset - thickness_) {
        planes_[n_planes_++] = {-normal, -low};
        break;
      }
    }
  }
}

Blocking PolygonShaft::test(const Occluder& occluder) const {
  if (boxes_are_apart(occluder.box, box_, thickness_)) return Blocking::none;
  const auto [low_a, high_a] = range_over(a_.points(), occluder.normal);
  const auto [low_b, high_b] = range_over(b_.points(), occluder.normal);
  const double above = occluder.offset + thickness_;
  const double below = occluder.offset - thickness_;
  if (std::min(low_a, low_b) >= below || std::max(high_a, high_b) <= above) return Blocking::none;
  for (std::size_t k = 0; k < n_planes_; ++k) {
    if (is_outside(occluder, planes_[k], thickness_)) return Blocking::none;
  }
  // A polygon may touch the occluder's plane, but not lie in it: it could be the occluder.
  const bool is_between = (low_a >= below && high_a > above && high_b <= above && low_b < below) ||
                          (low_b >= below && high_b > above && high_a <= above && low_a < below);
  if (is_between && cuts_all(occluder, a_.points(), b_.points())) return Blocking::all;
  return Blocking::some;
}

}  // namespace radiosity
