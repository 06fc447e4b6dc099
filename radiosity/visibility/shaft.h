#pragma once

#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity {

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
