#pragma once

#include <array>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/blocking.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity {

/// What one blocker hides of a target from any point of a source: the intersection of half-spaces
/// that depend on the point (each holds the point and an edge in its border) and of fixed ones.
/// Half-spaces that hold the whole target for every point are left out.
struct Shadow {
  /// An edge seen from the source, with the blocker on its left.
  struct Edge {
    Vec3 start;
    Vec3 end;
  };
  std::vector<Edge> edges;
  std::vector<HalfSpace> faces;  ///< the shadow lies behind these
  void clear();
};

/// All segments between two convex sets, given by their corners.
///
/// Proofs about patches in these sets rest on what touches what, decided here alone: a corner
/// within the thickness of a plane is in it. A patch in the plane of a polygon is not hidden by
/// it, a patch on a body's face from outside sees what is in front of that face, and a patch on a
/// face that looks into the body sees nothing. Either end may be called the source: the verdict is
/// the same.
class SegmentBundle {
 public:
  static constexpr std::size_t kMostCorners = 14;

  /// The hull of at most kMostCorners corners, which must outlive the bundle.
  struct ConvexSet {
    std::span<const Vec3> corners;
    bool is_flat;  ///< a point, a polygon, or what else is in one plane but for rounding
  };

  /// `thickness` is how far off a plane a point may be and still count as on it, m.
  SegmentBundle(const ConvexSet& source, const ConvexSet& target, double thickness);

  /// What a blocker does to the segments, and where a plane of it divides the source or the target
  /// so that nothing definite can be said.
  struct Verdict {
    Blocking blocking = Blocking::some;
    const HalfSpace* divides_source = nullptr;
    const HalfSpace* divides_target = nullptr;
  };

  /// Judges a blocker. `none` and `all` are proofs. If it is `some` and nothing is divided, the
  /// blocker's shadow on the target is appended to `shadow`, where given.
  [[nodiscard]] Verdict test(const Blocker& blocker, Shadow* shadow = nullptr) const;

  /// Whether no segment meets the blocker, given that what is inside it may block, too: as for a
  /// body around others.
  [[nodiscard]] bool misses(const Blocker& blocker) const;

  /// Whether all segments pass through the inside of a body, which is no polygon. The shadow that a
  /// convex body throws from a point is convex, so that the segments between corners tell.
  [[nodiscard]] bool is_pierced(const Blocker& body) const;

  /// Whether a face of the body has all of the source, or all of the target, in front of it.
  [[nodiscard]] bool is_end_outside(const Blocker& body) const;

 private:
  /// One of the two convex sets.
  struct End {
    std::span<const Vec3> corners;
    Vec3 center;
    double radius;
    bool is_flat;
  };
  /// Lowest and highest value.
  struct Range {
    double low;
    double high;
  };
  /// How far in front of each face the ends lie, m.
  struct Heights {
    std::array<Range, Blocker::kMostFaces> of_source;
    std::array<Range, Blocker::kMostFaces> of_target;
  };
  enum class Side { front, behind, both };
  /// What can be said of a blocker as seen from one end.
  struct Outlook {
    Blocking blocking = Blocking::some;
    bool is_inside = false;              ///< the end is inside the blocker
    const HalfSpace* divider = nullptr;  ///< a face's plane that cuts the end
  };

  static End make_end(const ConvexSet& set);
  static Range range_over(std::span<const Vec3> points, const HalfSpace& plane);
  [[nodiscard]] bool is_out_of_reach(const Blocker& blocker) const;
  /// Empty-handed (false) if a face proves that the blocker blocks nothing.
  [[nodiscard]] bool find_heights(const Blocker& blocker, Heights& heights) const;
  [[nodiscard]] Side side(const Range& height) const;
  [[nodiscard]] bool is_on(const Range& height) const;
  /// The proofs as seen from one end; `from_source` tells which. The shadow is appended if it is
  /// the source and nothing else is found.
  [[nodiscard]] Outlook look(const Blocker& blocker, const Heights& heights, bool from_source,
                             Shadow* shadow) const;
  [[nodiscard]] Blocking look_from_inside(const Blocker& blocker, const End& end,
                                          std::span<const Range> own,
                                          std::span<const Range> other) const;
  /// Lowest and highest value, over all segments from source to target, of how far they pass on the
  /// edge's left, times their length, m².
  [[nodiscard]] Range passing_of(const Vec3& start, const Vec3& end) const;
  /// Whether all segments pass on the edge's left (sign 1) or right (-1) but for what ends that are
  /// off by the thickness may cause.
  [[nodiscard]] bool all_pass(const Vec3& start, const Vec3& end, double sign) const;

  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kMostLines =
      (kMostCorners * kMostCorners + kLanes - 1) / kLanes * kLanes;

  double thickness_;
  End source_;
  End target_;
  Box3 box_;
  Vec3 axis_;                // from the source's centre to the target's
  double radius_ = 0;        // of a capsule about it that holds all segments
  std::size_t n_lines_ = 0;  // padded to whole lanes
  // Plücker coordinates of the lines between corners, (direction, moment).
  std::array<std::array<double, kMostLines>, 6> lines_;
};

}  // namespace radiosity
