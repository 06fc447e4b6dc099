#pragma once

#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/visibility/segment_bundle.h"

namespace radiosity {

/// How fine pieces beside edges are made.
struct Grading {
  double least_width = 0;       ///< narrower strips are left as they are, m
  double least_area = 0;        ///< as are smaller pieces, m²
  std::size_t most_pieces = 0;  ///< in all
};

/// Cuts pieces of a polygon's plane into strips along edges above it until none is wider, across an
/// edge, than three times its distance from that edge. What is seen past an edge at a height h
/// changes within h of it (its singularities lie on the edge), so that rules on wider pieces miss
/// it and agree by chance; on these a rule of n points is off by about 1.9^-2n (Bernstein 1912).
/// Edges that reach no higher than the least width are passed over: what changes beside them is in
/// strips that narrow. Returns whether all pieces are that small; where that takes too many it ends
/// with some.
bool grade_pieces(std::vector<ConvexPolygon>& pieces, const Vec3& normal,
                  std::span<const Shadow::Edge> edges, const Grading& grading);

}  // namespace radiosity
