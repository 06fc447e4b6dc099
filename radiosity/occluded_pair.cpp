#include "radiosity/occluded_pair.h"

#include <algorithm>
#include <cmath>

#include "radiosity/exchange_area.h"

namespace radiosity {
namespace {

/// Distant pairs with more candidates are not tested one by one: rays are cheaper.
constexpr std::size_t kMostTested = 32;
/// Relative error of the kernel where it is multiplied by a sampled fraction, far below its noise.
constexpr double kSampledTolerance = 1e-8;
/// Divisions of the larger polygon of a near pair at most.
constexpr int kMostDivisions = 8;
/// A polygon this much larger than the other is divided.
constexpr double kMuchLarger = 2;

class Estimator {
 public:
  Estimator(const Visibility& visibility, const OccludedPairOptions& options)
      : visibility_(visibility), options_(options) {}

  PairEstimate estimate(const SampledPair& pair, std::vector<const Occluder*> candidates,
                        int max_rays, std::uint64_t seed, int divisions) const {
    const Disc disc_i = bounding_disc(pair.polygon_i.points());
    const Disc disc_j = bounding_disc(pair.polygon_j.points());
    const bool is_near =
        (disc_i.center - disc_j.center).norm() < 2 * (disc_i.radius + disc_j.radius);
    if (is_near || candidates.size() <= kMostTested) {
      const Blocking blocking = reduce(pair, candidates);
      if (blocking == Blocking::all) return {0, 0, blocking, false, 0};
      if (blocking == Blocking::none) {
        return {unoccluded(pair, options_.kernel_tolerance), 0, blocking, false, 0};
      }
    }
    if (!is_near) return weigh(pair, sample_visible_fraction(visibility_, pair, max_rays, seed));
    const double ratio = disc_i.radius / disc_j.radius;
    if (divisions > 0 && std::max(ratio, 1 / ratio) > kMuchLarger) {
      return estimate_divided(pair, ratio > 1, candidates, max_rays, seed, divisions);
    }
    return weigh(pair,
                 clip_visible_fraction(pair, candidates, options_.thickness,
                                       std::max(max_rays / 4, SegmentSampler::kPacket), seed));
  }

 private:
  /// Drops the candidates that are proved not to block. `all` if one blocks everything.
  Blocking reduce(const SampledPair& pair, std::vector<const Occluder*>& candidates) const {
    const PolygonShaft shaft(pair.polygon_i, pair.plane_i, pair.polygon_j, pair.plane_j,
                             options_.thickness);
    std::size_t n_kept = 0;
    for (const Occluder* candidate : candidates) {
      const Blocking blocking = shaft.test(*candidate);
      if (blocking == Blocking::all) return blocking;
      if (blocking == Blocking::some) candidates[n_kept++] = candidate;
    }
    candidates.resize(n_kept);
    return candidates.empty() ? Blocking::none : Blocking::some;
  }

  [[nodiscard]] static double unoccluded(const SampledPair& pair, double tolerance) {
    return exchange_area(pair.polygon_i.points(), pair.polygon_j.points(), tolerance);
  }

  [[nodiscard]] static PairEstimate weigh(const SampledPair& pair,
                                          const VisibleFraction& fraction) {
    const double whole = unoccluded(pair, kSampledTolerance);
    return {fraction.value * whole, fraction.error * whole, Blocking::some, fraction.is_partial,
            fraction.rays};
  }

  [[nodiscard]] PairEstimate estimate_divided(const SampledPair& pair, bool divides_i,
                                              const std::vector<const Occluder*>& candidates,
                                              int max_rays, std::uint64_t seed,
                                              int divisions) const {
    const std::vector<ConvexPolygon> pieces =
        divide_about_corners(divides_i ? pair.polygon_i : pair.polygon_j);
    PairEstimate sum;
    bool any_visible = false;
    bool any_hidden = false;
    double variance = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const SampledPair part{divides_i ? pieces[k] : pair.polygon_i,
                             pair.plane_i,
                             divides_i ? pair.polygon_j : pieces[k],
                             pair.plane_j,
                             pair.origin,
                             pair.i,
                             pair.j};
      const PairEstimate estimate =
          this->estimate(part, candidates, std::max(max_rays / 2, 2 * SegmentSampler::kPacket),
                         pair_seed(seed, static_cast<std::int32_t>(k), divisions), divisions - 1);
      sum.value += estimate.value;
      sum.rays += estimate.rays;
      variance += estimate.error * estimate.error;
      sum.is_partial |= estimate.is_partial;
      any_visible |= estimate.value > 0;
      any_hidden |= estimate.blocking != Blocking::none;
    }
    sum.error = std::sqrt(variance);
    sum.is_partial |= any_visible && any_hidden;
    return sum;
  }

  const Visibility& visibility_;
  const OccludedPairOptions& options_;
};

}  // namespace

PairEstimate estimate_occluded_pair(const Visibility& visibility, const SampledPair& pair,
                                    std::vector<const Occluder*> candidates,
                                    const OccludedPairOptions& options, std::uint64_t seed) {
  return Estimator(visibility, options)
      .estimate(pair, std::move(candidates), options.max_rays, seed, kMostDivisions);
}

}  // namespace radiosity
