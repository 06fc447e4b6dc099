#include "radiosity/exchange/occluded_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "radiosity/exchange/even_points.h"
#include "radiosity/exchange/pair_method.h"
#include "radiosity/polygon/exchange_area.h"

namespace radiosity {
namespace {

/// One sigma of an uncertain entry is at least so many times the kernel's error.
constexpr double kKernelErrors = 10;
/// Divisions of a pair at most.
constexpr std::size_t kMostPairDivisions = 12;

// The error that a pair may have. With n samples the error of a pair of exchange area G falls like
// G n^-p, so that the sum of all errors is least for a given cost if each pair's error is in
// proportion to G^(1 / (1 + p)); p = ⅔ for quasi-random rays, which give 3/5. Were all pairs partly
// hidden and all of one size, each might have the tolerance as its relative error; few are, so that
// more will do.

constexpr double kErrorPower = 2.0 / 5;
/// Form factor that a pair may be off by, in tolerances: a few such may meet in a row.
constexpr double kRowShare = 0.22;
/// So few blockers cost less to look at than a packet.
constexpr std::size_t kFewCandidates = 4;
/// Rays see nothing within a gap at their ends; pairs closer than so many gaps go without them.
constexpr double kLeastGapsBetween = 64;
/// What rays' gaps take of a shadow is their share of the smaller polygon's width: more than this,
/// and more than the error that the pair may have, is too much.
constexpr double kMostGapOfWidth = 1e-3;
/// Blockers that are wholly so many gaps above an end are met by all rays from there.
constexpr double kGapsAbove = 2;
/// Rules that end so many times further off than asked leave it to even points.
constexpr double kTooFarOff = 2;
/// The standard error of what shadows that cross hide at events that were passed over, as a share
/// of what is aimed at.
constexpr double kCrossingError = 0.1;

/// One sigma of the share of an uncertain entry at least.
double least_error(const OccludedPairOptions& options) {
  return kKernelErrors * options.kernel_tolerance;
}

}  // namespace

OccludedPairEstimator::OccludedPairEstimator(const Visibility& visibility,
                                             const OccludedPairOptions& options)
    : visibility_(visibility),
      options_(options),
      points_({options.thickness, options.kernel_tolerance, least_error(options)}) {}

double OccludedPairEstimator::allowed_share(const PairView& view, double whole) const {
  // Small among all pairs, a pair may yet hold most of a small patch's row.
  const double of_row = kRowShare * options_.tolerance * view.source_area / whole;
  const double of_all =
      options_.budget * options_.tolerance * std::pow(options_.mean_area / whole, kErrorPower);
  return std::min(of_row, of_all);
}

bool OccludedPairEstimator::suits_rays(const PairView& view,
                                       std::span<const Blocker* const> blockers,
                                       double error) const {
  const double gap = visibility_.end_gap();
  const double share = std::max(error, kMostGapOfWidth);
  const double width = view.source_area / (2 * bounding_disc(view.source->points()).radius);
  if (view.distance < kLeastGapsBetween * gap || gap > share * width) return false;
  struct End {
    Vec3 corner;
    Vec3 normal;
    Box3 box;
  };
  const auto end_of = [](const ConvexPolygon& polygon, const Vec3& normal) {
    End end{polygon[0], normal, {}};
    for (const Vec3& corner : polygon) end.box.extend(corner);
    return end;
  };
  const std::array ends{end_of(*view.source, view.source_normal),
                        end_of(*view.target, vector_area(view.target->points()).normalized())};
  const auto sees = [&](const Blocker& blocker, const End& end) {
    if (blocker.box.exteriorDistance(end.box) > kGapsAbove * gap) return true;
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const Vec3& corner : blocker.corners) {
      const double height = end.normal.dot(corner - end.corner);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return high <= options_.thickness || low > kGapsAbove * gap || gap <= share * high;
  };
  return std::all_of(blockers.begin(), blockers.end(), [&](const Blocker* blocker) {
    return sees(*blocker, ends[0]) && sees(*blocker, ends[1]);
  });
}

PairEstimate OccludedPairEstimator::estimate(const SampledPair& pair,
                                             std::span<const Blocker* const> candidates,
                                             const std::function<double()>& unoccluded,
                                             std::uint64_t seed) {
  return estimate(pair, candidates, unoccluded, seed, 0);
}

PairEstimate OccludedPairEstimator::estimate(const SampledPair& pair,
                                             std::span<const Blocker* const> candidates,
                                             const std::function<double()>& unoccluded,
                                             std::uint64_t seed, std::size_t depth) {
  if (levels_.size() <= depth) levels_.resize(depth + 1);
  const PairView view(pair);
  std::optional<double> whole;
  std::optional<FractionSampler> sampler;
  if (!view.is_near && candidates.size() > kFewCandidates) {
    whole = unoccluded();
    const double error = allowed_share(view, *whole);
    if (are_rays_cheap(error) && suits_rays(view, candidates, error)) {
      // Rays whatever the proofs would be: those that disagree leave nothing to prove.
      sampler.emplace(visibility_, pair, seed);
      if (sampler->add_packet().is_partial) {
        return sampler->add_packets({error, kMostRays}).times(*whole);
      }
    }
  }
  const Blocking blocking =
      levels_[depth].find(*view.source, *view.target, candidates, options_.thickness);
  if (blocking == Blocking::all) return {0, 0, Blocking::all, false, 0};
  if (!whole) whole = unoccluded();
  if (blocking == Blocking::none) return {*whole, 0, Blocking::none, false, 0};
  if (sampler) return sampler->add_packets({allowed_share(view, *whole), kMostRays}).times(*whole);
  return estimate_unproved(pair, view, *whole, seed, depth);
}

PairEstimate OccludedPairEstimator::estimate_unproved(const SampledPair& pair, const PairView& view,
                                                      double whole, std::uint64_t seed,
                                                      std::size_t depth) {
  PairBlockers& between = levels_[depth];
  const double error = allowed_share(view, whole);
  const bool may_divide = depth < kMostPairDivisions;
  const PairMethod method =
      choose_method(view, between, error, suits_rays(view, between.blockers, error));
  const bool is_source_large = view.source->size() > kMostCorners;
  const bool is_large = is_source_large || view.target->size() > kMostCorners;
  if (method == PairMethod::rays) return cast_rays(pair, view, whole, error, seed);
  if (may_divide && is_large) {
    return divide(pair, is_source_large == view.from_i,
                  divide_about_corners(is_source_large ? *view.source : *view.target), depth, seed);
  }
  if (between.target_divider != nullptr && may_divide) {
    return divide(pair, !view.from_i,
                  halves(*view.target, *between.target_divider, options_.thickness), depth, seed);
  }
  if (is_large || between.target_divider != nullptr)
    return cast_rays(pair, view, whole, error, seed);
  const HalfSpace* divider = method == PairMethod::cuts ? between.source_divider : between.border;
  if (divider != nullptr && may_divide) {
    return divide(pair, view.from_i, halves(*view.source, *divider, options_.thickness), depth,
                  seed);
  }
  if (method == PairMethod::cuts && between.dividing.empty()) {
    return cut_shadows(view, between, whole, error, seed);
  }
  return sample_points(view, between, whole, error);
}

PairEstimate OccludedPairEstimator::divide(const SampledPair& pair, bool divides_i,
                                           std::span<const ConvexPolygon> pieces, std::size_t depth,
                                           std::uint64_t seed) {
  PairEstimate sum;
  bool all_hidden = true;
  bool all_visible = true;
  double variance = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k].size() < 3) continue;
    const SampledPair part{divides_i ? pieces[k] : pair.polygon_i,
                           pair.plane_i,
                           divides_i ? pair.polygon_j : pieces[k],
                           pair.plane_j,
                           pair.i,
                           pair.j};
    const std::uint64_t part_seed =
        pair_seed(seed, static_cast<std::int32_t>(k), static_cast<std::int32_t>(depth));
    const auto unoccluded = [&] {
      return exchange_area(part.polygon_i.points(), part.polygon_j.points(),
                           options_.kernel_tolerance);
    };
    const PairEstimate estimate =
        this->estimate(part, levels_[depth].blockers, unoccluded, part_seed, depth + 1);
    sum.value += estimate.value;
    sum.rays += estimate.rays;
    variance += estimate.error * estimate.error;
    sum.is_partial |= estimate.is_partial;
    all_visible &= estimate.blocking == Blocking::none;
    all_hidden &= estimate.blocking == Blocking::all;
  }
  sum.error = std::sqrt(variance);
  sum.blocking = all_hidden ? Blocking::all : all_visible ? Blocking::none : Blocking::some;
  sum.is_partial |= sum.value > 0 && !all_visible;
  return sum;
}

PairEstimate OccludedPairEstimator::cut_shadows(const PairView& view, const PairBlockers& between,
                                                double whole, double error, std::uint64_t seed) {
  const std::span<const Shadow> shadows(between.shadows.data(), between.blockers.size());
  const ShadowedPair shadowed{*view.source, view.source_normal, *view.target, shadows,
                              options_.thickness};
  PairEstimate fraction =
      quadrature_.integrate(shadowed, error, needs_adaption(view, between, error));
  if (fraction.blocking != Blocking::some) return fraction.times(whole);
  if (fraction.error > kTooFarOff * error) {
    const PairEstimate even = sample_evenly(shadowed, error, seed, even_cutter_);
    if (even.error < fraction.error) fraction = even;
  }
  // The kernel's own error counts, too: closing a row must not lean on entries that claim none. And
  // where shadows cross, events were passed over, which few points may miss altogether.
  const double least = least_error(options_);
  fraction.error = std::hypot(fraction.error,
                              shadows.size() > 1 ? std::max(least, kCrossingError * error) : least);
  return fraction.times(whole);
}

PairEstimate OccludedPairEstimator::sample_points(const PairView& view, PairBlockers& between,
                                                  double whole, double error) {
  return points_.sample(view, between, whole, error).times(whole);
}

PairEstimate OccludedPairEstimator::cast_rays(const SampledPair& pair, const PairView& view,
                                              double whole, double error,
                                              std::uint64_t seed) const {
  const Sampling sampling = view.is_near ? Sampling::directions : Sampling::areas;
  return sample_visible_fraction(visibility_, pair, {error, kMostRays}, seed, sampling)
      .times(whole);
}

}  // namespace radiosity
