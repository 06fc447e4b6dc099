#include "radiosity/exchange/pair_method.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/exchange/point_sampler.h"

namespace radiosity {
namespace {

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
constexpr double kPointCost = 0.3;
constexpr double kShadowCost = 0.4;
constexpr double kDividingCost = 0.6;
constexpr double kPointsOfBorder = 1.5;
/// What other methods cost at least, proofs included: rays go first where they cost less.
constexpr double kLookCost = 15;
/// A packet of rays even in directions, which near pairs need since samples of areas miss their
/// kernel's peaks.
constexpr double kNearPacketCost = 4.7;
/// More shadows cannot be divided at their events.
constexpr std::size_t kMostCuts = 12;
constexpr std::size_t kMostDividing = 3;

double packets_for(double error) {
  return std::max(1.0, std::pow(kRaySpread / error, kRayPower) / SegmentSampler::kPacket);
}

}  // namespace

bool are_rays_cheap(double error) { return kPacketCost * packets_for(error) <= kLookCost; }

bool needs_adaption(const PairView& view, const PairBlockers& between, double error) {
  // What is seen changes without bounds where a body stands on the source.
  const double low = between.blockers.size() == 1 ? kLowRule : kLowRuleOfMany;
  return view.is_near || between.any_beside || error < low;
}

PairMethod choose_method(const PairView& view, const PairBlockers& between, double error,
                         bool takes_rays) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto n_shadows = static_cast<double>(between.blockers.size());
  const auto n_dividing = static_cast<double>(between.dividing.size());
  const double point_cost = kPointCost +
                            kShadowCost * n_shadows * (1 + square(n_shadows / kManyShadows)) +
                            kDividingCost * n_dividing;
  const double packets = packets_for(error);
  const double packet_cost = view.is_near ? kNearPacketCost : kPacketCost;
  const double rays = takes_rays && packets <= kMostPackets ? packet_cost * packets : kNever;

  double cuts = kNever;
  if (between.dividing.size() <= kMostDividing && between.blockers.size() <= kMostCuts) {
    // Where a plane divides the source, that is divided first: some edges fewer on either side.
    std::size_t n_borders = 0;
    for (std::size_t k = 0; k < between.blockers.size(); ++k) {
      n_borders += between.shadows[k].edges.size() + between.shadows[k].faces.size();
    }
    for (const std::size_t k : between.dividing) n_borders += between.blockers[k]->edges.size() / 2;
    cuts = kPointsOfBorder * static_cast<double>(n_borders) * point_cost *
           (needs_adaption(view, between, error) ? kAdaptive : 1) *
           (between.blockers.size() > 1 ? kCrossing : 1);
  }
  const double n_points =
      kPointsOfFirst * std::max({1.0, kFirstPoints / error, square(PointSampler::kUnseen / error)});
  // Beside a body the light ends so suddenly that points and their quarters may agree by chance.
  const bool may_trust_points = !between.any_beside || cuts == kNever;
  const double points =
      may_trust_points && n_points <= PointSampler::kMostPoints ? n_points * point_cost : kNever;
  const double least = std::min({rays, cuts, points});
  // Where nothing gets as far as asked, rays get farthest.
  if (least == kNever) return takes_rays ? PairMethod::rays : PairMethod::points;
  if (rays == least) return PairMethod::rays;
  return cuts == least ? PairMethod::cuts : PairMethod::points;
}

}  // namespace radiosity
