#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>

#include "radiosity/exchange/pair_blockers.h"
#include "radiosity/exchange/pair_estimate.h"
#include "radiosity/exchange/pair_view.h"
#include "radiosity/exchange/point_sampler.h"
#include "radiosity/exchange/shadowed_quadrature.h"
#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

struct OccludedPairOptions {
  double tolerance = 1e-3;         ///< relative error of all exchange areas together aimed at
  double mean_area = 0;            ///< exchange area of a pair on average, m²
  double budget = 2;               ///< relative error, in tolerances, of a pair of this size
  double thickness = 0;            ///< how far off a plane a point may be and count as on it, m
  double kernel_tolerance = 1e-9;  ///< relative error of the kernel where visibility is proved
};

/// Estimates exchange areas of pairs given all blockers between them. Blockers are first proved
/// away, as seen from the smaller polygon (`PairBlockers`). What is left is a matter of cost: see
/// `allowed_share` in the source for how much error a pair may have, and `choose_method` for which
/// of rays, exact cuts of shadows and sampled shadows gets there soonest. Not to be shared by
/// threads.
class OccludedPairEstimator {
 public:
  OccludedPairEstimator(const Visibility& visibility, const OccludedPairOptions& options);

  /// The exchange area of a pair. `unoccluded` gives that without blockers, m²; it is called where
  /// needed.
  PairEstimate estimate(const SampledPair& pair, std::span<const Blocker* const> candidates,
                        const std::function<double()>& unoccluded, std::uint64_t seed);

 private:
  PairEstimate estimate(const SampledPair& pair, std::span<const Blocker* const> candidates,
                        const std::function<double()>& unoccluded, std::uint64_t seed,
                        std::size_t depth);
  PairEstimate estimate_unproved(const SampledPair& pair, const PairView& view, double whole,
                                 std::uint64_t seed, std::size_t depth);
  [[nodiscard]] double allowed_share(const PairView& view, double whole) const;
  /// Whether rays, which see nothing within a gap above their ends, tell well enough: by the size
  /// of the polygons and how close they are, and by what of a blocker is within the gap.
  [[nodiscard]] bool suits_rays(const PairView& view, std::span<const Blocker* const> blockers,
                                double error) const;
  PairEstimate divide(const SampledPair& pair, bool divides_i,
                      std::span<const ConvexPolygon> pieces, std::size_t depth, std::uint64_t seed);
  [[nodiscard]] PairEstimate cut_shadows(const PairView& view, const PairBlockers& between,
                                         double whole, double error, std::uint64_t seed);
  [[nodiscard]] PairEstimate sample_points(const PairView& view, PairBlockers& between,
                                           double whole, double error);
  [[nodiscard]] PairEstimate cast_rays(const SampledPair& pair, const PairView& view, double whole,
                                       double error, std::uint64_t seed) const;

  const Visibility& visibility_;
  OccludedPairOptions options_;
  std::deque<PairBlockers> levels_;  // of a pair, and of the parts into which it is divided
  ShadowedQuadrature quadrature_;
  ShadowCutter even_cutter_;
  PointSampler points_;
};

}  // namespace radiosity
