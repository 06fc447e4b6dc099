#include "radiosity/exchange/occluded_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {
namespace {

/// One sigma of an uncertain entry is at least so many times the kernel's error.
constexpr double kKernelErrors = 10;
/// Divisions of a pair at most.
constexpr std::size_t kMostDivisions = 12;
/// Polygons with more corners are divided, since each cut may add one.
constexpr std::size_t kMostCorners = 8;
/// Divisions of the source into quarters at most, where points are sampled.
constexpr std::size_t kMostQuarterings = 7;

// The cost model. With n samples the error of a pair of exchange area G falls like G n^-p, so that
// the sum of all errors is least for a given cost if each pair's error is in proportion to
// G^(1 / (1 + p)); p = ⅔ for quasi-random rays, which give 3/5. Were all pairs partly hidden and
// all of one size, each might have the tolerance as its relative error; few are, so that more will
// do.

constexpr double kErrorPower = 2.0 / 5;
/// Form factor that a pair may be off by, in tolerances: a few such may meet in a row.
constexpr double kRowShare = 0.22;
/// n rays have the error kRaySpread n^-⅔.
constexpr double kRaySpread = 0.36;
constexpr double kRayPower = 3.0 / 2;
/// Standard error of low rules on pieces that the shadows' events bound, for one shadow and for
/// several; and how much dearer rules are that go on until they agree.
constexpr double kLowRule = 2e-3;
constexpr double kLowRuleOfMany = 1e-2;
constexpr double kAdaptive = 4;
/// Standard error of four points and their four quarters; it falls like n^-1 as pieces with shadows
/// are divided, but for what is not seen between the points, which falls like n^-½.
constexpr double kFirstPoints = 1e-2;
constexpr int kPointsOfFirst = 20;
/// Shadows from which on the parts that they leave of a target multiply.
constexpr double kManyShadows = 16;
/// How much dearer cuts are where shadows may cross, which their pieces don't heed.
constexpr double kCrossing = 2.5;
// Costs on one core, µs (form_factor_bench, by perf): a packet of rays; a point from which a
// target is seen, and each shadow there; points that a border of a shadow brings with its pieces.
constexpr double kPacketCost = 2.2;
constexpr double kPointCost = 0.5;
constexpr double kShadowCost = 0.5;
constexpr double kDividingCost = 0.7;
constexpr double kPointsOfBorder = 1.5;
/// What other methods cost at least, proofs included: rays go first where they cost less.
constexpr double kLookCost = 15;
/// So few blockers cost less to look at than a packet.
constexpr std::size_t kFewCandidates = 4;
/// More shadows cannot be divided at their events.
constexpr std::size_t kMostCuts = 12;
constexpr std::size_t kMostDividing = 3;
/// The same, in directions, which near pairs need since samples of areas miss their kernel's peaks.
constexpr double kNearPacketCost = 4.7;
/// Rays at most, 10 ms of them.
constexpr double kMostPackets = 4096;
/// Rays see nothing within a gap at their ends; pairs closer than so many gaps go without them.
constexpr double kLeastGaps = 64;
constexpr int kMostRays = SegmentSampler::kPacket * static_cast<int>(kMostPackets);

/// The standard error of a piece's four quarters as a share of how far they are off the piece in
/// all and one by one, and of what is aimed at, since these may be small by chance.
constexpr double kRuleError = 0.3;
constexpr double kQuarterError = 0.2;
constexpr double kChanceError = 0.1;
/// Error of the kernel of parts that are proved visible or hidden, of what is asked of the pair.
constexpr double kPartKernel = 1e-3;
/// The standard error of what points miss as a share of it.
constexpr double kMissed = 0.5;
/// The same of what their rule misses of the unobstructed kernel.
constexpr double kPeakError = 0.3;
/// The standard error of what happens between the twenty points of a piece and its quarters, such
/// as a strip along its border from which alone the target is seen, as a share of all.
constexpr double kUnseen = 0.005;
/// How near a body is beside the source, in sizes of that: its faces then divide it for points.
constexpr double kBeside = 0.1;
/// Points for a pair at most: what does not settle by then has the error that it has.
constexpr int kMostPoints = 300;

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

/// Planes that have all segments between two polygons on one side, about the line between their
/// middles: they prove in nanoseconds that a blocker's box is in nobody's way.
class PairHull {
 public:
  PairHull(const ConvexPolygon& source, const ConvexPolygon& target, double thickness) {
    const Vec3 from = bounding_disc(source.points()).center;
    const Vec3 way = bounding_disc(target.points()).center - from;
    const double length = way.norm();
    const Vec3 along = length > 0 ? Vec3(way / length) : Vec3(Vec3::UnitX());
    const Vec3 u = along.unitOrthogonal();
    const Vec3 v = along.cross(u);
    find_planes(source, target, along, u, v, thickness);
  }

  __attribute__((target_clones("arch=x86-64-v3", "default"))) [[nodiscard]] bool misses(
      const Box3& box) const {
    const double x = box.min().x() + box.max().x();
    const double y = box.min().y() + box.max().y();
    const double z = box.min().z() + box.max().z();
    const double wide = box.max().x() - box.min().x();
    const double deep = box.max().y() - box.min().y();
    const double high = box.max().z() - box.min().z();
    int n_beyond = 0;
    for (int k = 0; k < kPlanes; ++k) {
      const double center = x_[k] * x + y_[k] * y + z_[k] * z;
      const double reach = std::abs(x_[k]) * wide + std::abs(y_[k]) * deep + std::abs(z_[k]) * high;
      n_beyond += center - reach >= 2 * offset_[k] ? 1 : 0;
    }
    return n_beyond > 0;
  }

 private:
  static constexpr int kPlanes = 8;

  __attribute__((target_clones("arch=x86-64-v3", "default"))) void find_planes(
      const ConvexPolygon& source, const ConvexPolygon& target, const Vec3& along, const Vec3& u,
      const Vec3& v, double thickness) {
    constexpr double kHalf = 0.70710678118654752;
    constexpr std::array<double, kPlanes> kCosine{1, kHalf, 0, -kHalf, -1, -kHalf, 0, kHalf};
    constexpr std::array<double, kPlanes> kSine{0, kHalf, 1, kHalf, 0, -kHalf, -1, -kHalf};
    // The highest corner of each polygon in each direction, and how far along the line it is.
    struct Highest {
      std::array<double, kPlanes> height;
      std::array<double, kPlanes> place;
    };
    const auto find_highest = [&](const ConvexPolygon& polygon, Highest& highest) {
      for (int k = 0; k < kPlanes; ++k) highest.height[k] = -1e300;
      for (const Vec3& corner : polygon) {
        const double a = u.dot(corner);
        const double b = v.dot(corner);
        const double c = along.dot(corner);
        for (int k = 0; k < kPlanes; ++k) {
          const double height = kCosine[k] * a + kSine[k] * b;
          const bool is_higher = height > highest.height[k];
          highest.height[k] = is_higher ? height : highest.height[k];
          highest.place[k] = is_higher ? c : highest.place[k];
        }
      }
    };
    Highest of_source;
    Highest of_target;
    find_highest(source, of_source);
    find_highest(target, of_target);
    std::array<double, kPlanes> slope;
    for (int k = 0; k < kPlanes; ++k) {
      const double run = of_target.place[k] - of_source.place[k];
      slope[k] = run > 0 ? (of_target.height[k] - of_source.height[k]) / run : 0;
      offset_[k] = -1e300;
    }
    for (const ConvexPolygon* polygon : {&source, &target}) {
      for (const Vec3& corner : *polygon) {
        const double a = u.dot(corner);
        const double b = v.dot(corner);
        const double c = along.dot(corner);
        for (int k = 0; k < kPlanes; ++k) {
          const double height = kCosine[k] * a + kSine[k] * b - slope[k] * c;
          offset_[k] = height > offset_[k] ? height : offset_[k];
        }
      }
    }
    for (int k = 0; k < kPlanes; ++k) {
      x_[k] = kCosine[k] * u.x() + kSine[k] * v.x() - slope[k] * along.x();
      y_[k] = kCosine[k] * u.y() + kSine[k] * v.y() - slope[k] * along.y();
      z_[k] = kCosine[k] * u.z() + kSine[k] * v.z() - slope[k] * along.z();
      offset_[k] -= thickness * std::sqrt(1 + slope[k] * slope[k]);
    }
  }

  std::array<double, kPlanes> x_;
  std::array<double, kPlanes> y_;
  std::array<double, kPlanes> z_;
  std::array<double, kPlanes> offset_;
};

PairEstimate weigh(const VisibleFraction& fraction, double whole) {
  return {fraction.value * whole, fraction.error * whole, Blocking::some, fraction.is_partial,
          fraction.rays};
}

double packets_for(double error) {
  return std::max(1.0, std::pow(kRaySpread / error, kRayPower) / SegmentSampler::kPacket);
}

/// Whether a point is inside a blocker, or on its surface with nothing of the target beyond.
bool is_inside(const Blocker& blocker, const Vec3& point, const ConvexPolygon& target,
               double thickness) {
  return std::all_of(blocker.faces.begin(), blocker.faces.end(), [&](const HalfSpace& face) {
    const double height = face.normal.dot(point) - face.offset;
    if (height < -thickness) return true;
    if (height > thickness) return false;
    return std::all_of(target.begin(), target.end(), [&](const Vec3& corner) {
      return face.normal.dot(corner) - face.offset <= thickness;
    });
  });
}

/// What 16 points of a piece of the source may miss of blockers that hide the target from a spot
/// smaller than their spacing only, as a share of what the piece sees.
double missed_share(const ConvexPolygon& piece, const Vec3& normal,
                    std::span<const Blocker* const> blockers) {
  const double area = vector_area(piece.points()).norm();
  const double spacing = bounding_disc(piece.points()).radius / 2;
  double squares = 0;
  for (const Blocker* blocker : blockers) {
    // The height of the box's middle, which is above its lowest corner by half of its size at most.
    const double height = normal.dot(blocker->box.center() - piece[0]);
    const double spot = std::max(height, 0.0) + 0.5 * blocker->box.diagonal().norm();
    if (spot < spacing) squares += square(kMissed * square(spot) / area);
  }
  return std::sqrt(squares);
}

}  // namespace

double OccludedPairEstimator::allowed_share(const View& view, double whole) const {
  // Small among all pairs, a pair may yet hold most of a small patch's row.
  const double of_row = kRowShare * options_.tolerance * view.source_area / whole;
  const double of_all =
      options_.budget * options_.tolerance * std::pow(options_.mean_area / whole, kErrorPower);
  return std::min(of_row, of_all);
}

bool OccludedPairEstimator::suits_rays(const View& view) const {
  return view.distance >= kLeastGaps * visibility_.end_gap();
}

OccludedPairEstimator::Method OccludedPairEstimator::choose_method(const View& view,
                                                                   const Level& level,
                                                                   double error) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto n_shadows = static_cast<double>(level.blockers.size());
  const auto n_dividing = static_cast<double>(level.dividing.size());
  const double point_cost = kPointCost +
                            kShadowCost * n_shadows * (1 + square(n_shadows / kManyShadows)) +
                            kDividingCost * n_dividing;
  const double packets = packets_for(error);
  const double packet_cost = view.is_near ? kNearPacketCost : kPacketCost;
  const bool takes_rays = suits_rays(view);
  const double rays = takes_rays && packets <= kMostPackets ? packet_cost * packets : kNever;

  double cuts = kNever;
  if (level.dividing.size() <= kMostDividing && level.blockers.size() <= kMostCuts) {
    // Where a plane divides the source, that is divided first: some edges fewer on either side.
    std::size_t n_borders = 0;
    for (std::size_t k = 0; k < level.blockers.size(); ++k) {
      n_borders += level.shadows[k].edges.size() + level.shadows[k].faces.size();
    }
    for (const std::size_t k : level.dividing) n_borders += level.blockers[k]->edges.size() / 2;
    const double low = level.blockers.size() == 1 ? kLowRule : kLowRuleOfMany;
    const bool adapts = view.is_near || error < low;
    cuts = kPointsOfBorder * static_cast<double>(n_borders) * point_cost *
           (adapts ? kAdaptive : 1) * (level.blockers.size() > 1 ? kCrossing : 1);
  }
  const double n_points =
      kPointsOfFirst * std::max({1.0, kFirstPoints / error, square(kUnseen / error)});
  const double points = n_points <= kMostPoints ? n_points * point_cost : kNever;
  const double least = std::min({rays, cuts, points});
  // Where nothing gets as far as asked, rays get farthest.
  if (least == kNever) return takes_rays ? Method::rays : Method::points;
  if (rays == least) return Method::rays;
  return cuts == least ? Method::cuts : Method::points;
}

void OccludedPairEstimator::PointSums::add(const PointSums& other) {
  whole += other.whole;
  visible += other.visible;
  variance += other.variance;
}

PairEstimate OccludedPairEstimator::estimate(const SampledPair& pair,
                                             std::span<const Blocker* const> candidates,
                                             const std::function<double()>& unoccluded,
                                             std::uint64_t seed) {
  return estimate(pair, candidates, unoccluded, seed, 0);
}

OccludedPairEstimator::View::View(const SampledPair& pair) {
  constexpr double kNear = 2;
  const double area_i = vector_area(pair.polygon_i.points()).norm();
  const double area_j = vector_area(pair.polygon_j.points()).norm();
  from_i = area_i <= area_j;
  source = from_i ? &pair.polygon_i : &pair.polygon_j;
  target = from_i ? &pair.polygon_j : &pair.polygon_i;
  source_normal = from_i ? pair.plane_i.normal : pair.plane_j.normal;
  source_area = std::min(area_i, area_j);
  const Disc disc_source = bounding_disc(source->points());
  const Disc disc_target = bounding_disc(target->points());
  distance = (disc_source.center - disc_target.center).norm();
  is_near = distance < kNear * (disc_source.radius + disc_target.radius);
}

PairEstimate OccludedPairEstimator::estimate(const SampledPair& pair,
                                             std::span<const Blocker* const> candidates,
                                             const std::function<double()>& unoccluded,
                                             std::uint64_t seed, std::size_t depth) {
  if (levels_.size() <= depth) levels_.resize(depth + 1);
  const View view(pair);
  std::optional<double> whole;
  std::optional<FractionSampler> sampler;
  if (!view.is_near && candidates.size() > kFewCandidates && suits_rays(view)) {
    whole = unoccluded();
    const double error = allowed_share(view, *whole);
    if (kPacketCost * packets_for(error) <= kLookCost) {
      // Rays whatever the proofs would be: those that disagree leave nothing to prove.
      sampler.emplace(visibility_, pair, seed);
      if (sampler->add_packet().is_partial) {
        return weigh(sampler->add_packets({error, kMostRays}), *whole);
      }
    }
  }
  const Blocking blocking = find_shadows(*view.source, *view.target, candidates, levels_[depth]);
  if (blocking == Blocking::all) return {0, 0, Blocking::all, false, 0};
  if (!whole) whole = unoccluded();
  if (blocking == Blocking::none) return {*whole, 0, Blocking::none, false, 0};
  if (sampler) return weigh(sampler->add_packets({allowed_share(view, *whole), kMostRays}), *whole);
  return estimate_unproved(pair, view, *whole, seed, depth);
}

Blocking OccludedPairEstimator::find_shadows(const ConvexPolygon& source,
                                             const ConvexPolygon& target,
                                             std::span<const Blocker* const> candidates,
                                             Level& level) const {
  level.blockers.clear();
  level.dividing.clear();
  level.source_divider = nullptr;
  level.target_divider = nullptr;
  level.border = nullptr;
  Box3 source_box;
  for (const Vec3& corner : source) source_box.extend(corner);
  const double source_size = source_box.diagonal().norm();
  const PairHull hull(source, target, options_.thickness);
  std::optional<SegmentBundle> bundle;
  for (const Blocker* candidate : candidates) {
    if (hull.misses(candidate->box)) continue;
    if (!bundle) bundle.emplace(source.points(), target.points(), options_.thickness);
    const std::size_t n_kept = level.blockers.size();
    if (level.shadows.size() <= n_kept) level.shadows.resize(n_kept + 1);
    Shadow& shadow = level.shadows[n_kept];
    shadow.clear();
    const SegmentBundle::Verdict verdict = bundle->test(*candidate, &shadow);
    if (verdict.blocking == Blocking::all) return Blocking::all;
    if (verdict.blocking == Blocking::none) continue;
    const bool divides = verdict.divides_source != nullptr || verdict.divides_target != nullptr;
    if (divides && misses_halves(source, target, *candidate, verdict, options_.thickness)) {
      continue;
    }
    level.blockers.push_back(candidate);
    if (verdict.divides_source != nullptr) level.dividing.push_back(n_kept);
    if (level.source_divider == nullptr) level.source_divider = verdict.divides_source;
    if (level.target_divider == nullptr) level.target_divider = verdict.divides_target;
    // Right beside the source light ends so suddenly that a rule's points miss where it does.
    const double gap = candidate->box.exteriorDistance(source_box);
    const bool is_beside = gap <= std::max(options_.thickness, kBeside * source_size);
    if (is_beside && level.border == nullptr) level.border = verdict.divides_source;
  }
  return level.blockers.empty() ? Blocking::none : Blocking::some;
}

PairEstimate OccludedPairEstimator::estimate_unproved(const SampledPair& pair, const View& view,
                                                      double whole, std::uint64_t seed,
                                                      std::size_t depth) {
  const Level& level = levels_[depth];
  const double error = allowed_share(view, whole);
  const bool may_divide = depth < kMostDivisions;
  const Method method = choose_method(view, level, error);
  const bool is_source_large = view.source->size() > kMostCorners;
  const bool is_large = is_source_large || view.target->size() > kMostCorners;
  if (method == Method::rays) return cast_rays(pair, view, whole, error, seed);
  if (may_divide && is_large) {
    return divide(pair, is_source_large == view.from_i,
                  divide_about_corners(is_source_large ? *view.source : *view.target), depth, seed);
  }
  if (level.target_divider != nullptr && may_divide) {
    return divide(pair, !view.from_i,
                  halves(*view.target, *level.target_divider, options_.thickness), depth, seed);
  }
  if (is_large || level.target_divider != nullptr) return cast_rays(pair, view, whole, error, seed);
  const HalfSpace* divider = method == Method::cuts ? level.source_divider : level.border;
  if (divider != nullptr && may_divide) {
    return divide(pair, view.from_i, halves(*view.source, *divider, options_.thickness), depth,
                  seed);
  }
  if (method == Method::cuts && level.dividing.empty()) {
    return cut_shadows(view, {level.shadows.data(), level.blockers.size()}, whole, error);
  }
  return sample_points(view, whole, error, depth);
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

PairEstimate OccludedPairEstimator::cut_shadows(const View& view, std::span<const Shadow> shadows,
                                                double whole, double error) {
  const ShadowedPair shadowed{*view.source, view.source_normal, *view.target, shadows,
                              options_.thickness};
  const bool adapts = view.is_near || error < (shadows.size() == 1 ? kLowRule : kLowRuleOfMany);
  const VisibleShare share = quadrature_.integrate(shadowed, error, adapts);
  if (share.is_exact && share.value == 0) return {0, 0, Blocking::all, false, 0};
  if (share.is_exact) return {whole, 0, Blocking::none, false, 0};
  // The kernel's own error counts, too: closing a row must not lean on entries that claim none. And
  // where shadows cross, events were passed over, which few points may miss altogether.
  const double least = kKernelErrors * options_.kernel_tolerance;
  const double sigma =
      std::hypot(share.error, shadows.size() > 1 ? std::max(least, kChanceError * error) : least);
  return {share.value * whole, sigma * whole, Blocking::some, share.value > 0 && share.value < 1,
          0};
}

PairEstimate OccludedPairEstimator::cast_rays(const SampledPair& pair, const View& view,
                                              double whole, double error,
                                              std::uint64_t seed) const {
  const Sampling sampling = view.is_near ? Sampling::directions : Sampling::areas;
  return weigh(sample_visible_fraction(visibility_, pair, {error, kMostRays}, seed, sampling),
               whole);
}

PairEstimate OccludedPairEstimator::sample_points(const View& view, double whole, double error,
                                                  std::size_t depth) {
  const std::size_t last_depth = depth + kMostQuarterings;
  if (levels_.size() <= last_depth + 1) levels_.resize(last_depth + 2);
  points_left_ = kMostPoints;
  part_tolerance_ = std::max(options_.kernel_tolerance, kPartKernel * error);
  const PointSums coarse = apply_rule(view, *view.source, levels_[depth]);
  PointSums sums;
  add_parts(view, *view.source, coarse, error * coarse.whole, depth, last_depth, sums);
  if (sums.whole <= 0) return {};
  const double share = sums.visible / sums.whole;
  const double missed = kPeakError * (sums.whole - whole) / whole;
  const double sigma = std::hypot(std::sqrt(sums.variance) / sums.whole, missed,
                                  kKernelErrors * options_.kernel_tolerance);
  return {share * whole, sigma * whole, Blocking::some, share > 0 && share < 1, 0};
}

OccludedPairEstimator::PointSums OccludedPairEstimator::apply_rule(const View& view,
                                                                   const ConvexPolygon& piece,
                                                                   Level& level) {
  constexpr int kOrder = 2;
  PointSums sums;
  const auto visible_from = [&](const Vec3& point, double whole) {
    if (!level.dividing.empty()) {
      const SegmentBundle bundle(std::span(&point, 1), view.target->points(), options_.thickness);
      for (const std::size_t k : level.dividing) {
        level.shadows[k].clear();
        const auto verdict = bundle.test(*level.blockers[k], &level.shadows[k]);
        if (verdict.blocking == Blocking::all) return 0.0;
        if (verdict.divides_target == nullptr) continue;
        // From inside a body only what else is inside can be seen, and that is next to nothing.
        if (is_inside(*level.blockers[k], point, *view.target, options_.thickness)) return 0.0;
      }
    }
    return cutter_.visible_part(point, view.source_normal, *view.target, whole,
                                {level.shadows.data(), level.blockers.size()});
  };
  constexpr std::array<std::size_t, 4> kCornerOfPoint{0, 3, 1, 2};
  sums.has_quarters = piece.size() == 4;
  std::size_t n_points = 0;
  for_each_quadrature_point(piece.points(), kOrder, [&](const Vec3& point, double weight) {
    const std::size_t corner = kCornerOfPoint[n_points++ % 4];
    --points_left_;
    const double whole = facing_point_to_polygon(point, view.source_normal, view.target->points());
    if (!(whole > 0)) return;  // in the target's plane but for rounding
    const double visible = visible_from(point, whole);
    sums.whole += weight * whole;
    sums.visible += weight * visible;
    sums.quarter_whole[corner] = weight * whole;
    sums.quarter_visible[corner] = weight * visible;
  });
  return sums;
}

OccludedPairEstimator::PointSums OccludedPairEstimator::look_at_part(const View& view,
                                                                     const ConvexPolygon& part,
                                                                     std::size_t depth) {
  Level& level = levels_[depth + 1];
  const Blocking blocking = find_shadows(part, *view.target, levels_[depth].blockers, level);
  if (blocking == Blocking::some && level.target_divider == nullptr) {
    return apply_rule(view, part, level);
  }
  const double whole = exchange_area(part.points(), view.target->points(), part_tolerance_);
  return {whole, blocking == Blocking::all ? 0 : whole, 0, blocking != Blocking::some};
}

void OccludedPairEstimator::add_parts(const View& view, const ConvexPolygon& piece,
                                      const PointSums& coarse, double goal, std::size_t depth,
                                      std::size_t last_depth, PointSums& sums) {
  const std::vector<ConvexPolygon> parts = divide_about_corners(piece);
  std::array<PointSums, kMostCorners> fine;
  PointSums total;
  bool is_proved = true;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    fine[k] = look_at_part(view, parts[k], depth);
    total.add(fine[k]);
    is_proved &= fine[k].is_proved;
  }
  if (is_proved) {
    sums.add(total);
    return;
  }
  const double share = total.whole > 0 ? total.visible / total.whole : 0;
  // The sum may agree by chance, four quarters hardly ever do.
  const double change = total.visible - coarse.visible - share * (total.whole - coarse.whole);
  double squares = 0;
  for (std::size_t k = 0; coarse.has_quarters && k < parts.size(); ++k) {
    squares += square(fine[k].visible - coarse.quarter_visible[k] -
                      share * (fine[k].whole - coarse.quarter_whole[k]));
  }
  double variance = square(kRuleError * change) + square(kQuarterError) * squares;
  // Where the kernel peaks between the points, what is seen there is not known.
  variance += square(kPeakError * (total.whole - coarse.whole));
  variance += square(kUnseen * total.whole);
  variance +=
      square(total.whole * missed_share(piece, view.source_normal, levels_[depth].blockers));
  const bool is_good = coarse.has_quarters && variance <= square(goal);
  if (is_good || depth + 1 >= last_depth || points_left_ <= 0) {
    total.variance += variance + square(kChanceError * goal);
    sums.add(total);
    return;
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (fine[k].is_proved) {
      sums.add(fine[k]);
      continue;
    }
    find_shadows(parts[k], *view.target, levels_[depth].blockers, levels_[depth + 1]);
    add_parts(view, parts[k], fine[k], goal / 2, depth + 1, last_depth, sums);
  }
}

}  // namespace radiosity
