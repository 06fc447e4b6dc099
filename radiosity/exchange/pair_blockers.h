#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/segment_bundle.h"

namespace radiosity {

/// Polygons with more corners are divided, since each cut may add one.
inline constexpr std::size_t kMostCorners = 8;

/// The parts of a polygon in front of a plane and behind it; one is empty if all is on one side.
std::array<ConvexPolygon, 2> halves(const ConvexPolygon& polygon, const HalfSpace& plane,
                                    double thickness);

/// The blockers between two polygons that no proof does away with, and what they throw. Keeps its
/// memory from call to call.
struct PairBlockers {
  std::vector<const Blocker*> blockers;
  std::vector<Shadow> shadows;        ///< of the blockers; empty where it depends on the point
  std::vector<std::size_t> dividing;  ///< blockers with a plane that divides the source
  const HalfSpace* source_divider = nullptr;  ///< a face's plane that cuts the polygon
  const HalfSpace* target_divider = nullptr;
  /// As source_divider, of a blocker that stands on the source: what it covers ends there.
  const HalfSpace* border = nullptr;
  bool any_beside = false;  ///< a blocker stands right beside the source

  /// Finds them among the candidates, which must outlive them. `none` and `all` are proofs; after
  /// `all` the members are unfinished. `thickness` is how far off a plane points may be and still
  /// count as on it, m.
  Blocking find(const ConvexPolygon& source, const ConvexPolygon& target,
                std::span<const Blocker* const> candidates, double thickness);
};

}  // namespace radiosity
