#include "radiosity/visibility/cluster_visibility.h"

#include <algorithm>

#include "radiosity/visibility/segment_bundle.h"
#include "radiosity/visibility/shaft.h"

namespace radiosity {
namespace {

/// Nodes smaller than this share of the larger cluster are not opened: their parts would hardly be
/// told apart.
constexpr double kOpenedSize = 0.5;
constexpr double kSmall = 0.5;

class Filter {
 public:
  Filter(const Cluster& a, const Cluster& b, const BlockerSet& blockers, double thickness)
      : a_(a),
        b_(b),
        blockers_(blockers),
        thickness_(thickness),
        is_last_(a.is_leaf() && b.is_leaf()),
        least_size_(kOpenedSize * std::max(a.box.diagonal().norm(), b.box.diagonal().norm())),
        small_(kSmall * std::min(a.box.diagonal().norm(), b.box.diagonal().norm())),
        shaft_(a.box, b.box) {}

  std::optional<Candidates> run(std::span<const std::int32_t> candidates) {
    open_.assign(candidates.rbegin(), candidates.rend());
    while (!open_.empty()) {
      const std::int32_t k = open_.back();
      open_.pop_back();
      const BlockerSet::Node& node = blockers_.nodes[k];
      const bool is_hiding = node.is_leaf() ? test_leaf(k) : test_group(k);
      if (is_hiding) return std::nullopt;
    }
    return std::move(kept_);
  }

 private:
  const SegmentBundle& bundle() {
    if (!bundle_) {
      bundle_.emplace(SegmentBundle::ConvexSet{a_.outline, a_.is_flat},
                      SegmentBundle::ConvexSet{b_.outline, b_.is_flat}, thickness_);
    }
    return *bundle_;
  }

  /// Keeps a leaf if need be; true if it hides everything.
  bool test_leaf(std::int32_t k) {
    const Blocker& blocker = blockers_.blocker(k);
    if (shaft_.misses(blocker.box, blocker.corners, thickness_)) return false;
    // What is small beside the clusters is in the way of few pairs and hides none of them all.
    if (is_last_ && blocker.is_flat() && blocker.radius < small_) {
      kept_.push_back(k);
      return false;
    }
    const SegmentBundle::Verdict verdict = bundle().test(blocker);
    if (verdict.blocking == Blocking::none) return false;
    if (verdict.blocking == Blocking::all) return true;
    kept_.push_back(k);
    return false;
  }

  /// Keeps or opens a node of several; true if what is within it hides everything.
  bool test_group(std::int32_t k) {
    const BlockerSet::Node& node = blockers_.nodes[k];
    if (shaft_.misses(node.box, thickness_)) return false;
    if (!node.outer.empty()) {
      const Blocker& outer = node.outer[0];
      if (shaft_.misses(outer.box, outer.corners, thickness_)) return false;
      if (bundle().misses(outer)) return false;
      if (!node.inner.empty() && bundle().is_end_outside(outer) &&
          bundle().is_pierced(node.inner[0])) {
        return true;
      }
    }
    // What has bodies around and within may yet be missed, or hide, as a whole.
    const bool opens = node.outer.empty() && node.box.diagonal().norm() >= least_size_;
    if (is_last_ || opens) {
      open_.push_back(node.right);
      open_.push_back(node.left);
    } else {
      kept_.push_back(k);
    }
    return false;
  }

  const Cluster& a_;
  const Cluster& b_;
  const BlockerSet& blockers_;
  double thickness_;
  bool is_last_;
  double least_size_;
  double small_;
  BoxShaft shaft_;
  std::optional<SegmentBundle> bundle_;
  Candidates open_;
  Candidates kept_;
};

}  // namespace

Candidates all_candidates(const BlockerSet& blockers) {
  return blockers.root < 0 ? Candidates() : Candidates{blockers.root};
}

std::optional<Candidates> possible_blockers(const Cluster& a, const Cluster& b,
                                            const BlockerSet& blockers,
                                            std::span<const std::int32_t> candidates,
                                            double thickness) {
  if (candidates.empty()) return Candidates();
  return Filter(a, b, blockers, thickness).run(candidates);
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
