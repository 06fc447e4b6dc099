#pragma once

#include <array>
#include <span>
#include <vector>

#include "radiosity/convex_polygon.h"
#include "radiosity/geometry.h"
#include "radiosity/occluders.h"

namespace radiosity {

/// The oriented plane normal · x = offset; outside is normal · x > offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// What an occluder can do to the segments between two sets of points. Only `none` and `all` are
/// proofs; `some` may also stand for "not found out".
enum class Blocking { none, some, all };

/// The convex hull of two boxes, as half-spaces that all segments between them stay in. (Haines &
/// Wallace 1991)
class BoxShaft {
 public:
  BoxShaft(const Box3& a, const Box3& b);

  /// Whether the occluder blocks the segments between the boxes; `thickness` (m) is how deep into
  /// the shaft it may reach and still count as outside.
  [[nodiscard]] Blocking test(const Occluder& occluder, double thickness) const;

 private:
  Box3 a_;
  Box3 b_;
  Box3 both_;
  std::vector<HalfSpace> planes_;
};

/// The convex hull of two convex polygons that face each other.
class PolygonShaft {
 public:
  PolygonShaft(const ConvexPolygon& a, const HalfSpace& plane_a, const ConvexPolygon& b,
               const HalfSpace& plane_b, double thickness);

  /// Whether the occluder blocks the segments between the polygons.
  [[nodiscard]] Blocking test(const Occluder& occluder) const;

 private:
  void add_supporting_planes(const ConvexPolygon& p, const ConvexPolygon& q);

  const ConvexPolygon& a_;
  const ConvexPolygon& b_;
  double thickness_;
  Box3 box_;
  std::array<HalfSpace, 2 + 2 * ConvexPolygon::kCapacity> planes_;
  std::size_t n_planes_ = 0;
};

}  // namespace radiosity
