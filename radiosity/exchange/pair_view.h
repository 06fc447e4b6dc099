#pragma once

#include "radiosity/base/geometry.h"
#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/polygon/convex_polygon.h"

namespace radiosity {

/// A pair as seen from its smaller polygon. Refers to the pair's polygons.
struct PairView {
  explicit PairView(const SampledPair& pair);
  bool from_i;  ///< whether that polygon is the smaller one
  const ConvexPolygon* source;
  const ConvexPolygon* target;
  Vec3 source_normal;
  double source_area;  ///< m²
  double distance;     ///< of their middles, m
  bool is_near;        ///< closer than twice their radii: the kernel peaks
};

}  // namespace radiosity
