#pragma once

#include <cstdint>

#include "radiosity/convex_polygon.h"
#include "radiosity/shaft.h"
#include "radiosity/visibility.h"

namespace radiosity {

/// A pair of patches as a visibility estimate sees it.
struct SampledPair {
  const ConvexPolygon& polygon_i;  ///< the part in front of j, relative to `origin`
  const HalfSpace& plane_i;
  const ConvexPolygon& polygon_j;  ///< the part in front of i, relative to `origin`
  const HalfSpace& plane_j;
  Vec3 origin;     ///< of the polygons' coordinates, m
  std::int32_t i;  ///< patches, for Visibility
  std::int32_t j;
};

/// Kernel-weighted visible fraction of a pair, in [0, 1], with its standard error.
struct VisibleFraction {
  double value = 0;
  double error = 0;
  int rays = 0;
  bool is_partial = false;  ///< samples disagree
};

/// Estimates ∫∫ K V / ∫∫ K with K = cosθ_i cosθ_j / (π r²) from packets of segments between
/// quasi-random points, shifted at random by `seed` (which should depend on the pair). Takes
/// `max_rays`, or two packets if all of these agree.
VisibleFraction sample_visible_fraction(const Visibility& visibility, const SampledPair& pair,
                                        int max_rays, std::uint64_t seed);

/// A seed for a pair from the run's seed. (SplitMix64, Steele et al. 2014)
std::uint64_t pair_seed(std::uint64_t seed, std::int32_t i, std::int32_t j);

}  // namespace radiosity
