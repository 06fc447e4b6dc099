#include "radiosity/exchange/pair_blockers.h"

#include <algorithm>
#include <optional>

#include "radiosity/exchange/pair_hull.h"

namespace radiosity {
namespace {

/// How near a body is beside the source, in sizes of that: its faces then divide it for points.
constexpr double kBeside = 0.1;
/// So few blockers cost less to test than what would prove of most that they are in nobody's way.
constexpr std::size_t kTooFewForHull = 2;

/// Whether a blocker that divides the source or the target blocks nothing of any half.
bool misses_halves(const ConvexPolygon& source, const ConvexPolygon& target, const Blocker& blocker,
                   const SegmentBundle::Verdict& verdict, double thickness) {
  const bool divides_source = verdict.divides_source != nullptr;
  const HalfSpace& plane = divides_source ? *verdict.divides_source : *verdict.divides_target;
  const ConvexPolygon& divided = divides_source ? source : target;
  if (divided.size() > kMostCorners) return false;
  for (const ConvexPolygon& half : halves(divided, plane, thickness)) {
    if (half.size() < 3) continue;
    const SegmentBundle bundle({divides_source ? half.points() : source.points(), true},
                               {divides_source ? target.points() : half.points(), true}, thickness);
    if (bundle.test(blocker).blocking != Blocking::none) return false;
  }
  return true;
}

}  // namespace

std::array<ConvexPolygon, 2> halves(const ConvexPolygon& polygon, const HalfSpace& plane,
                                    double thickness) {
  std::array<ConvexPolygon, 2> parts;
  split(polygon, plane.normal * plane.offset, plane.normal, thickness, parts[0], parts[1]);
  return parts;
}

Blocking PairBlockers::find(const ConvexPolygon& source, const ConvexPolygon& target,
                            std::span<const Blocker* const> candidates, double thickness) {
  blockers.clear();
  dividing.clear();
  source_divider = nullptr;
  target_divider = nullptr;
  border = nullptr;
  any_beside = false;
  Box3 source_box;
  for (const Vec3& corner : source) source_box.extend(corner);
  const double source_size = source_box.diagonal().norm();
  std::optional<PairHull> hull;
  if (candidates.size() > kTooFewForHull) hull.emplace(source, target, thickness);
  std::optional<SegmentBundle> bundle;
  for (const Blocker* candidate : candidates) {
    if (hull && hull->misses(candidate->box)) continue;
    if (!bundle) {
      bundle.emplace(SegmentBundle::ConvexSet{source.points(), true},
                     SegmentBundle::ConvexSet{target.points(), true}, thickness);
    }
    const std::size_t n_kept = blockers.size();
    if (shadows.size() <= n_kept) shadows.resize(n_kept + 1);
    Shadow& shadow = shadows[n_kept];
    shadow.clear();
    const SegmentBundle::Verdict verdict = bundle->test(*candidate, &shadow);
    if (verdict.blocking == Blocking::all) return Blocking::all;
    if (verdict.blocking == Blocking::none) continue;
    const bool divides = verdict.divides_source != nullptr || verdict.divides_target != nullptr;
    if (divides && misses_halves(source, target, *candidate, verdict, thickness)) {
      continue;
    }
    blockers.push_back(candidate);
    if (verdict.divides_source != nullptr) dividing.push_back(n_kept);
    if (source_divider == nullptr) source_divider = verdict.divides_source;
    if (target_divider == nullptr) target_divider = verdict.divides_target;
    // Right beside the source light ends so suddenly that a rule's points miss where it does.
    const double gap = candidate->box.exteriorDistance(source_box);
    const bool is_beside = gap <= std::max(thickness, kBeside * source_size);
    any_beside |= is_beside;
    if (is_beside && border == nullptr) border = verdict.divides_source;
  }
  return blockers.empty() ? Blocking::none : Blocking::some;
}

}  // namespace radiosity
