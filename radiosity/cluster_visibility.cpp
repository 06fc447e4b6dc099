#include "radiosity/cluster_visibility.h"

#include <algorithm>

#include "radiosity/segment_bundle.h"
#include "radiosity/shaft.h"

namespace radiosity {

std::optional<Candidates> possible_blockers(const Cluster& a, const Cluster& b,
                                            const std::vector<Blocker>& blockers,
                                            std::span<const std::int32_t> candidates,
                                            double thickness) {
  Candidates kept;
  if (candidates.empty()) return kept;
  const bool is_last = a.is_leaf() && b.is_leaf();
  const BoxShaft shaft(a.box, b.box);
  std::optional<SegmentBundle> there;
  std::optional<SegmentBundle> back;
  for (const std::int32_t k : candidates) {
    const Blocker& blocker = blockers[k];
    if (shaft.misses(blocker.box, blocker.corners, thickness)) continue;
    if (!there) there.emplace(a.outline, b.outline, thickness);
    SegmentBundle::Verdict verdict = there->test(blocker);
    const bool is_divided = verdict.divides_source != nullptr;
    if (verdict.blocking == Blocking::some) {
      if (!back) back.emplace(b.outline, a.outline, thickness);
      verdict = back->test(blocker);
    }
    if (verdict.blocking == Blocking::all) return std::nullopt;
    if (verdict.blocking == Blocking::none) continue;
    if (is_last && is_divided && verdict.divides_source != nullptr &&
        there->is_separated(blocker)) {
      continue;
    }
    kept.push_back(k);
  }
  return kept;
}

bool are_averted(const Cluster& a, const Cluster& b, double thickness) {
  const auto is_behind = [&](const Cluster& cluster, const Cluster& of) {
    if (!of.plane) return false;
    return std::all_of(cluster.outline.begin(), cluster.outline.end(), [&](const Vec3& corner) {
      return of.plane->normal.dot(corner) <= of.plane->offset + thickness;
    });
  };
  return is_behind(a, b) || is_behind(b, a);
}

}  // namespace radiosity
