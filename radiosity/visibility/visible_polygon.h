#pragma once

#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/visibility/occluders.h"
#include "radiosity/visibility/segment_bundle.h"

namespace radiosity {

/// Cuts shadows out of polygons as seen from a point. Keeps its memory from call to call.
class ShadowCutter {
 public:
  /// Form factor from a surface element at `point` with unit `normal` to the part of `target` that
  /// lies in none of the shadows: exact up to rounding. The target lies wholly in front of the
  /// element and faces it; `whole` is the form factor to all of it. (Weiler & Atherton 1977;
  /// Lambert's formula for the parts)
  double visible_part(const Vec3& point, const Vec3& normal, const ConvexPolygon& target,
                      double whole, std::span<const Shadow> shadows);

  /// The convex parts of `target` that lie in none of the shadows as seen from `point`, valid until
  /// the next call.
  std::span<const ConvexPolygon> visible_parts(const Vec3& point, const ConvexPolygon& target,
                                               std::span<const Shadow> shadows);

 private:
  std::vector<ConvexPolygon> parts_;
  std::vector<ConvexPolygon> next_parts_;
};

/// What an occluder hides from a point, in full; nothing if the point is within `thickness` (m) of
/// its plane.
Shadow shadow_of(const Occluder& occluder, const Vec3& point, double thickness);

/// `visible_part` given the polygons that may cast shadows. Those within `thickness` (m) of the
/// point's own place are passed over.
double visible_point_to_polygon(const Vec3& point, const Vec3& normal, const ConvexPolygon& target,
                                std::span<const Occluder* const> occluders, double thickness);

}  // namespace radiosity
