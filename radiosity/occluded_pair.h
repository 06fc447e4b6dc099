#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/blocker.h"
#include "radiosity/shadowed_quadrature.h"
#include "radiosity/visible_fraction.h"

namespace radiosity {

/// Exchange area of a pair that something may block, m².
struct PairEstimate {
  double value = 0;
  double error = 0;                    ///< one sigma; 0 if `blocking` is a proof
  Blocking blocking = Blocking::some;  ///< none and all are proofs
  bool is_partial = false;             ///< found to be partly hidden
  int rays = 0;
};

struct OccludedPairOptions {
  int max_rays = 64;               ///< for a pair whose samples disagree
  double minor = 0;                ///< form factors below this may be coarse
  double negligible = 0;           ///< of those below this nothing is found out
  double thickness = 0;            ///< how far off a plane a point may be and count as on it, m
  double tolerance = 1e-3;         ///< relative error aimed at where shadows are cut out exactly
  double kernel_tolerance = 1e-9;  ///< relative error of the kernel where visibility is proved
};

/// Estimates exchange areas of pairs given all blockers between them. Blockers are first proved
/// away one by one, as seen from the smaller polygon. The shadows of those that are left are cut
/// out of the larger one exactly, for quadrature points on pieces of the smaller one within which
/// the shadows keep their shape. Pairs with too many shadows go to rays. Not to be shared by
/// threads.
class OccludedPairEstimator {
 public:
  OccludedPairEstimator(const Visibility& visibility, const OccludedPairOptions& options)
      : visibility_(visibility), options_(options) {}

  /// `unoccluded` gives the exchange area without blockers, m²; it is called where needed.
  PairEstimate estimate(const SampledPair& pair, std::span<const Blocker* const> candidates,
                        const std::function<double()>& unoccluded, std::uint64_t seed);

 private:
  /// What is kept of a pair, and of the parts into which it is divided, at each depth.
  struct Level {
    std::vector<const Blocker*> blockers;
    std::vector<Shadow> shadows;                ///< of the blockers
    const HalfSpace* source_divider = nullptr;  ///< a face's plane that cuts the polygon
    const HalfSpace* target_divider = nullptr;
  };
  /// A pair as seen from its smaller polygon.
  struct View {
    explicit View(const SampledPair& pair);
    bool from_i;
    const ConvexPolygon* source;
    const ConvexPolygon* target;
    double source_area;  ///< m²
    bool is_near;
    bool is_uneven;  ///< the target is much larger
  };

  PairEstimate estimate(const SampledPair& pair, std::span<const Blocker* const> candidates,
                        const std::function<double()>& unoccluded, std::uint64_t seed,
                        std::size_t depth);
  /// Keeps the candidates that are not proved away, and their shadows.
  Blocking find_shadows(const View& view, std::span<const Blocker* const> candidates,
                        Level& level) const;
  PairEstimate estimate_unproved(const SampledPair& pair, const View& view, double whole,
                                 std::uint64_t seed, std::size_t depth);
  PairEstimate divide(const SampledPair& pair, bool divides_i,
                      std::span<const ConvexPolygon> pieces, std::size_t depth, std::uint64_t seed);
  [[nodiscard]] PairEstimate cut_shadows(const SampledPair& pair, bool from_i, bool is_near,
                                         std::span<const Shadow> shadows, double whole);
  [[nodiscard]] PairEstimate cast_rays(const SampledPair& pair, double whole, bool is_minor,
                                       std::uint64_t seed) const;

  const Visibility& visibility_;
  OccludedPairOptions options_;
  std::deque<Level> levels_;
  ShadowedQuadrature quadrature_;
};

}  // namespace radiosity
