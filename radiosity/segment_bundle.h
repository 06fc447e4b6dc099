#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/blocker.h"
#include "radiosity/geometry.h"
#include "radiosity/shaft.h"

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
class SegmentBundle {
 public:
  static constexpr std::size_t kMostCorners = 14;

  /// At most kMostCorners corners each. `thickness` is how far off a plane a point may be and still
  /// count as on it, m. The corners must outlive the bundle.
  SegmentBundle(std::span<const Vec3> source, std::span<const Vec3> target, double thickness);

  /// What a blocker does to the segments, and where a plane of it divides the source or the target
  /// so that nothing definite can be said.
  struct Verdict {
    Blocking blocking = Blocking::some;
    const HalfSpace* divides_source = nullptr;
    const HalfSpace* divides_target = nullptr;
  };

  /// Judges a blocker. `none` and `all` are proofs. If it is `some` and nothing is divided, the
  /// blocker's shadow is appended to `shadow`, where given.
  [[nodiscard]] Verdict test(const Blocker& blocker, Shadow* shadow = nullptr) const;

  /// Whether a plane through an edge of the blocker and a corner of the source or the target has
  /// the blocker on one side and all segments on the other: a proof that it blocks nothing, also
  /// where its own planes divide them. Costs more than `test`.
  [[nodiscard]] bool is_separated(const Blocker& blocker) const;

 private:
  /// Where a point set lies with respect to a plane.
  struct Range {
    double low;
    double high;
  };
  enum class Side { front, behind, both };
  /// Where source and target lie with respect to a blocker's faces.
  struct Sides {
    std::array<Side, Blocker::kMostFaces> of_source;
    std::array<bool, Blocker::kMostFaces> is_target_behind;
    const HalfSpace* source_divider = nullptr;
    const HalfSpace* target_divider = nullptr;
    bool sees_a_face = false;        ///< the source is in front of one
    bool touches_seen_face = false;  ///< the target reaches one of these
    bool is_target_outside = false;  ///< in front of a face
    bool is_source_on_face = false;  ///< with some of the target in front of that face
    bool touches_own_face = false;   ///< the source reaches such a face
  };
  /// Empty if source and target are in front of one face, or the source in the plane of a polygon.
  [[nodiscard]] std::optional<Sides> find_sides(const Blocker& blocker) const;
  [[nodiscard]] Verdict test_from_inside(const Sides& sides) const;
  static Range range_over(std::span<const Vec3> points, const Vec3& normal);
  /// Lowest and highest value, over all segments, of how far they pass on the edge's left, times
  /// their length, m².
  [[nodiscard]] Range passing_of(const Vec3& start, const Vec3& end) const;

  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kMostLines =
      (kMostCorners * kMostCorners + kLanes - 1) / kLanes * kLanes;

  std::span<const Vec3> source_;
  std::span<const Vec3> target_;
  double thickness_;
  Box3 box_;
  std::size_t n_lines_ = 0;  // padded to whole lanes
  double least_side_ = 0;    // what counts as touching: the thickness times the longest length
  // Plücker coordinates of the lines between corners, (direction, moment).
  std::array<std::array<double, kMostLines>, 6> lines_;
};

}  // namespace radiosity
