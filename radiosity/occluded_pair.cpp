#include "radiosity/occluded_pair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/exchange_area.h"

namespace radiosity {
namespace {

/// One sigma of an uncertain entry is at least so many times the kernel's error.
constexpr double kKernelErrors = 10;
/// Divisions of a pair at most, and of one whose form factor is negligible.
constexpr std::size_t kMostDivisions = 12;
constexpr std::size_t kMinorDivisions = 2;
/// Rays for a negligible pair.
constexpr int kMinorRays = 2 * SegmentSampler::kPacket;
/// Of a near pair, a polygon this much larger than the other is divided.
constexpr double kMuchLarger = 2;
/// Polygons with more corners are divided, since each cut may add one.
constexpr std::size_t kMostCorners = 8;
/// Pairs with more shadows are sampled; with fewer if the tolerance is not below the next figure.
constexpr std::size_t kMostShadows = 12;
constexpr std::size_t kFewShadows = 3;
constexpr double kExactTolerance = 1e-4;
/// Pairs with more blockers go to rays; distant ones sooner, and with many candidates at once, if
/// little is asked.
constexpr std::size_t kMostSampled = 32;
constexpr std::size_t kMostSampledFar = 6;
constexpr std::size_t kMostTested = 32;
constexpr double kRayTolerance = 2e-3;
/// So many times more points for near pairs, over which the kernel varies strongly.
constexpr int kNearPackets = 4;
/// Above this tolerance one low rule has to do for distant pairs.
constexpr double kLowRuleTolerance = 5e-4;

std::array<ConvexPolygon, 2> halves(const ConvexPolygon& polygon, const HalfSpace& plane,
                                    double thickness) {
  const Vec3 on_plane = plane.normal * plane.offset;
  return {clip_to_half_space(polygon.points(), on_plane, plane.normal, thickness),
          clip_to_half_space(polygon.points(), on_plane, -plane.normal, thickness)};
}

/// Whether a blocker that divides the source or the target blocks nothing of any half.
bool misses_halves(const ConvexPolygon& source, const ConvexPolygon& target, const Blocker& blocker,
                   const SegmentBundle::Verdict& verdict, double thickness) {
  const bool divides_source = verdict.divides_source != nullptr;
  const HalfSpace& plane = divides_source ? *verdict.divides_source : *verdict.divides_target;
  const ConvexPolygon& divided = divides_source ? source : target;
  if (divided.size() > kMostCorners) return false;
  for (const ConvexPolygon& half : halves(divided, plane, thickness)) {
    if (half.size() < 3) continue;
    const SegmentBundle bundle(divides_source ? half.points() : source.points(),
                               divides_source ? target.points() : half.points(), thickness);
    if (bundle.test(blocker).blocking != Blocking::none) return false;
  }
  return true;
}

/// Packets of points from which the shadows are cut out, where the source is not divided: their
/// error falls a little slower than their number rises.
int packets_for(double tolerance) {
  return static_cast<int>(std::lround(std::clamp(std::sqrt(1e-2 / tolerance), 1.0, 16.0)));
}

PairEstimate weigh(const VisibleFraction& fraction, double whole) {
  return {fraction.value * whole, fraction.error * whole, Blocking::some, fraction.is_partial,
          fraction.rays};
}

}  // namespace

PairEstimate OccludedPairEstimator::estimate(const SampledPair& pair,
                                             std::span<const Blocker* const> candidates,
                                             const std::function<double()>& unoccluded,
                                             std::uint64_t seed) {
  return estimate(pair, candidates, unoccluded, seed, 0);
}

OccludedPairEstimator::View::View(const SampledPair& pair) {
  const double area_i = vector_area(pair.polygon_i.points()).norm();
  const double area_j = vector_area(pair.polygon_j.points()).norm();
  from_i = area_i <= area_j;
  source = from_i ? &pair.polygon_i : &pair.polygon_j;
  target = from_i ? &pair.polygon_j : &pair.polygon_i;
  source_area = std::min(area_i, area_j);
  const Disc disc_source = bounding_disc(source->points());
  const Disc disc_target = bounding_disc(target->points());
  const double distance = (disc_source.center - disc_target.center).norm();
  is_near = distance < 2 * (disc_source.radius + disc_target.radius);
  is_uneven = disc_target.radius > kMuchLarger * disc_source.radius;
}

PairEstimate OccludedPairEstimator::estimate(const SampledPair& pair,
                                             std::span<const Blocker* const> candidates,
                                             const std::function<double()>& unoccluded,
                                             std::uint64_t seed, std::size_t depth) {
  if (levels_.size() <= depth) levels_.resize(depth + 1);
  const View view(pair);
  if (!view.is_near && options_.tolerance >= kRayTolerance && candidates.size() > kMostTested) {
    const double whole = unoccluded();
    return cast_rays(pair, whole, whole < options_.minor * view.source_area, seed);
  }
  const Blocking blocking = find_shadows(view, candidates, levels_[depth]);
  if (blocking == Blocking::all) return {0, 0, Blocking::all, false, 0};
  const double whole = unoccluded();
  if (blocking == Blocking::none) return {whole, 0, Blocking::none, false, 0};
  if (whole < options_.negligible * view.source_area) {
    // Anything from nothing to all of it, at even odds.
    return {0.5 * whole, whole / std::sqrt(12.0), Blocking::some, false, 0};
  }
  return estimate_unproved(pair, view, whole, seed, depth);
}

Blocking OccludedPairEstimator::find_shadows(const View& view,
                                             std::span<const Blocker* const> candidates,
                                             Level& level) const {
  level.blockers.clear();
  level.source_divider = nullptr;
  level.target_divider = nullptr;
  const SegmentBundle bundle(view.source->points(), view.target->points(), options_.thickness);
  for (const Blocker* candidate : candidates) {
    const std::size_t n_kept = level.blockers.size();
    if (level.shadows.size() <= n_kept) level.shadows.resize(n_kept + 1);
    Shadow& shadow = level.shadows[n_kept];
    shadow.clear();
    const SegmentBundle::Verdict verdict = bundle.test(*candidate, &shadow);
    if (verdict.blocking == Blocking::all) return Blocking::all;
    if (verdict.blocking == Blocking::none) continue;
    const bool divides = verdict.divides_source != nullptr || verdict.divides_target != nullptr;
    if (divides &&
        misses_halves(*view.source, *view.target, *candidate, verdict, options_.thickness)) {
      continue;
    }
    level.blockers.push_back(candidate);
    if (level.source_divider == nullptr) level.source_divider = verdict.divides_source;
    if (level.target_divider == nullptr) level.target_divider = verdict.divides_target;
  }
  return level.blockers.empty() ? Blocking::none : Blocking::some;
}

PairEstimate OccludedPairEstimator::estimate_unproved(const SampledPair& pair, const View& view,
                                                      double whole, std::uint64_t seed,
                                                      std::size_t depth) {
  const Level& level = levels_[depth];
  const std::size_t n_blockers = level.blockers.size();
  const bool is_minor = whole < options_.minor * view.source_area;
  const bool may_divide = depth < (is_minor ? kMinorDivisions : kMostDivisions);
  const bool is_source_large = view.source->size() > kMostCorners;
  if (may_divide && (is_source_large || view.target->size() > kMostCorners)) {
    return divide(pair, is_source_large == view.from_i,
                  divide_about_corners(is_source_large ? *view.source : *view.target), depth, seed);
  }
  // Many shadows have too many events for exact pieces to pay, unless much is asked.
  const bool is_cluttered =
      n_blockers > (options_.tolerance < kExactTolerance ? kMostShadows : kFewShadows);
  const bool divides_source = level.source_divider != nullptr;
  const HalfSpace* divider = divides_source ? level.source_divider : level.target_divider;
  if (!is_cluttered && divider == nullptr) {
    return cut_shadows(pair, view.from_i, view.is_near && !is_minor,
                       {level.shadows.data(), n_blockers}, whole);
  }
  if (!is_cluttered && may_divide) {
    return divide(
        pair, divides_source == view.from_i,
        halves(divides_source ? *view.source : *view.target, *divider, options_.thickness), depth,
        seed);
  }
  const bool is_far = !view.is_near && options_.tolerance >= kRayTolerance;
  if (level.target_divider == nullptr && n_blockers <= (is_far ? kMostSampledFar : kMostSampled)) {
    const int packets = is_minor       ? 1
                        : view.is_near ? kNearPackets * packets_for(options_.tolerance)
                                       : packets_for(options_.tolerance);
    const int n_points = SegmentSampler::kPacket * packets;
    return weigh(sample_shadowed_fraction(pair, level.blockers, options_.thickness, n_points, seed),
                 whole);
  }
  // Rays between a small and a large near polygon have a variance without bound.
  if (may_divide && view.is_near && view.is_uneven) {
    return divide(pair, !view.from_i, divide_about_corners(*view.target), depth, seed);
  }
  return cast_rays(pair, whole, is_minor, seed);
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
                           pair.origin,
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

PairEstimate OccludedPairEstimator::cut_shadows(const SampledPair& pair, bool from_i, bool is_near,
                                                std::span<const Shadow> shadows, double whole) {
  const ShadowedPair shadowed{from_i ? pair.polygon_i : pair.polygon_j,
                              from_i ? pair.plane_i.normal : pair.plane_j.normal,
                              from_i ? pair.polygon_j : pair.polygon_i, shadows};
  const bool adapts = is_near || options_.tolerance < kLowRuleTolerance;
  const VisibleShare share = quadrature_.integrate(shadowed, options_.tolerance, adapts);
  if (share.is_exact && share.value == 0) return {0, 0, Blocking::all, false, 0};
  if (share.is_exact) return {whole, 0, Blocking::none, false, 0};
  // The kernel's own error counts, too: closing a row must not lean on entries that claim none.
  const double error = std::hypot(share.error, kKernelErrors * options_.kernel_tolerance);
  return {share.value * whole, error * whole, Blocking::some, share.value > 0 && share.value < 1,
          0};
}

PairEstimate OccludedPairEstimator::cast_rays(const SampledPair& pair, double whole, bool is_minor,
                                              std::uint64_t seed) const {
  const int rays = is_minor ? kMinorRays : options_.max_rays;
  return weigh(sample_visible_fraction(visibility_, pair, rays, seed), whole);
}

}  // namespace radiosity
