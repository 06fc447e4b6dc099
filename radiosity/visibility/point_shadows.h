#pragma once

#include <span>
#include <vector>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/occluders.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {

/// A point that emits, m, and the direction that it faces: in the plane of a polygon it belongs to
/// the side that it faces, or in front of it if it looks along it, so that the polygon that it is
/// mounted on hides what is behind.
struct PointLight {
  Vec3 position;
  Vec3 axis;
};

/// What points reach of a mesh. All patches block light, whichever side they turn to it. Shadows
/// are exact up to rounding: whatever is in the way is cut out of a patch as the point sees it
/// (Weiler & Atherton 1977). Immutable; may be used by many threads.
class PointShadows {
 public:
  /// The mesh must outlive this.
  explicit PointShadows(const PatchMesh& mesh);

  /// What of a patch the light reaches: convex parts, their corners relative to the light, m,
  /// counter-clockwise as it sees them. Empty if it is not in front of the patch. `cutter` keeps
  /// the memory from call to call; the parts are valid until its next use.
  std::span<const ConvexPolygon> lit_parts(const PointLight& light, Index patch,
                                           ShadowCutter& cutter) const;

  /// Whether the light reaches a point, m. What lies in a plane with either does not block it, but
  /// for what the light is mounted on.
  [[nodiscard]] bool is_lit(const PointLight& light, const Vec3& point) const;

  /// What of polygons that emit a point sees: convex parts, corners relative to the point, m, as
  /// are those of the polygons. What they are mounted on, in whose plane they lie, hides them from
  /// behind it, told by the direction `axis` that they face.
  [[nodiscard]] std::vector<ConvexPolygon> seen_parts(const Vec3& point,
                                                      std::span<const ConvexPolygon> polygons,
                                                      const Vec3& axis, ShadowCutter& cutter) const;

  /// How far off a plane points may be and still count as on it, m.
  [[nodiscard]] double thickness() const { return thickness_; }

 private:
  /// Calls visit(occluder) for all that may be between the light and the hull of `ends`, some of
  /// them repeatedly; relative to the mesh's centre.
  template <typename Visit>
  void for_each_between(const Vec3& light, std::span<const Vec3> ends, const Visit& visit) const;

  const PatchMesh& mesh_;
  Vec3 center_;
  double thickness_;
  std::vector<Occluder> occluders_;  // relative to the centre
  BoxTree tree_;                     // of them
};

}  // namespace radiosity
