#pragma once

#include <array>
#include <cstdint>

#include "radiosity/blocker.h"
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

/// Quasi-random segments between the polygons of a pair: the additive recurrence with the
/// generalised golden ratio of four dimensions (Roberts 2018), shifted at random by `seed`.
class SegmentSampler {
 public:
  static constexpr int kPacket = Visibility::kPacket;
  using Points = std::array<Vec3, kPacket>;
  using Weights = std::array<double, kPacket>;

  SegmentSampler(const SampledPair& pair, std::uint64_t seed);

  /// The ends (m) and kernels cosθ_i cosθ_j / r², up to a constant, of the next segments.
  struct Packet {
    Points from;
    Points to;
    Weights weight;
  };
  Packet next();

 private:
  /// Maps the unit square to points of equal density on a convex polygon, by a fan of triangles.
  struct Fan {
    explicit Fan(const ConvexPolygon& polygon);
    [[nodiscard]] Vec3 point(double u, double v) const;
    const ConvexPolygon& polygon;
    std::array<double, ConvexPolygon::kCapacity> cumulative{};
    double total = 0;
  };

  const SampledPair& pair_;
  Fan fan_i_;
  Fan fan_j_;
  std::array<double, 4> state_{};
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

/// The same from `n_points` quasi-random points on the smaller polygon, as seen from each of which
/// the blockers' shadows are cut out of the other: free of the noise that the singular kernel of
/// near pairs brings to rays. `blockers` are all that may block the pair, relative to `origin`;
/// `thickness` is how far off a plane a point may be and still count as on it, m.
VisibleFraction sample_shadowed_fraction(const SampledPair& pair,
                                         std::span<const Blocker* const> blockers, double thickness,
                                         int n_points, std::uint64_t seed);

/// A seed for a pair from the run's seed. (SplitMix64, Steele et al. 2014)
std::uint64_t pair_seed(std::uint64_t seed, std::int32_t i, std::int32_t j);

}  // namespace radiosity
