#pragma once

#include <span>
#include <vector>

#include "radiosity/base/geometry.h"

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

  /// Whether a convex body in the given box and with the given corners is proved to be outside;
  /// `thickness` (m) is how deep into the shaft it may reach and still count so.
  [[nodiscard]] bool misses(const Box3& box, std::span<const Vec3> corners, double thickness) const;
  /// The same for a box.
  [[nodiscard]] bool misses(const Box3& box, double thickness) const;

 private:
  Box3 both_;
  std::vector<HalfSpace> planes_;
};

}  // namespace radiosity
