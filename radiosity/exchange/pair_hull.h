#pragma once

#include <array>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"

namespace radiosity {

/// Planes that have all segments between two polygons on one side, about the line between their
/// middles: they prove in nanoseconds that a blocker's box is in nobody's way.
class PairHull {
 public:
  /// `thickness` is how deep into the hull a box may reach and still be in nobody's way, m.
  PairHull(const ConvexPolygon& source, const ConvexPolygon& target, double thickness);

  /// Whether a plane has the whole box beyond it, so that no segment meets what is in the box. That
  /// is a proof; false proves nothing.
  [[nodiscard]] bool misses(const Box3& box) const;

 private:
  static constexpr int kPlanes = 8;

  void find_planes(const ConvexPolygon& source, const ConvexPolygon& target, const Vec3& along,
                   const Vec3& u, const Vec3& v, double thickness);

  std::array<double, kPlanes> x_;
  std::array<double, kPlanes> y_;
  std::array<double, kPlanes> z_;
  std::array<double, kPlanes> offset_;
};

}  // namespace radiosity
