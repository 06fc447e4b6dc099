#include "radiosity/exchange/polygon_exchange.h"

#include <algorithm>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/exchange/pair_blockers.h"
#include "radiosity/polygon/exchange_area.h"

namespace radiosity {
namespace {

/// Clusters that are worked on in parallel, at least, if there are enough patches.
constexpr Index kParts = 512;

class PolygonRow {
 public:
  PolygonRow(const ExchangeEvaluator& evaluator, const ConvexPolygon& polygon, std::int32_t patch,
             double tolerance, std::uint64_t seed)
      : evaluator_(evaluator),
        polygon_(polygon),
        patch_(patch),
        plane_(evaluator.prepared().planes[patch]),
        seed_(seed),
        cluster_(cluster_of(polygon, plane_)) {
    const auto n = static_cast<double>(std::max<Index>(evaluator.size(), 1));
    // That of the polygon with a patch on average, if a quarter of what leaves it meets patches.
    options_ = {.tolerance = tolerance,
                .mean_area = 0.25 * vector_area(polygon.points()).norm() / n,
                .thickness = evaluator.prepared().thickness,
                .kernel_tolerance = kKernelTolerance};
  }

  /// Adds what the patches of a cluster exchange with the polygon.
  void visit(std::int32_t cluster, Eigen::VectorXd& result) const {
    ExchangeEvaluator::Worker worker{OccludedPairEstimator(evaluator_.visibility(), options_)};
    visit(cluster, evaluator_.everything().candidates, worker, result);
  }

 private:
  static constexpr double kKernelTolerance = 1e-6;

  void visit(std::int32_t k, const Candidates& wider, ExchangeEvaluator::Worker& worker,
             Eigen::VectorXd& result) const {
    const PreparedMesh& prepared = evaluator_.prepared();
    const Cluster& cluster = prepared.tree.clusters[k];
    if (are_averted(cluster_, cluster, prepared.thickness)) return;
    const auto kept =
        possible_blockers(cluster_, cluster, prepared.blockers, wider, prepared.thickness);
    if (!kept) return;
    if (!cluster.is_leaf()) {
      visit(cluster.left, *kept, worker, result);
      visit(cluster.right, *kept, worker, result);
      return;
    }
    for (Index c = cluster.begin; c < cluster.end; ++c) {
      const std::int32_t i = prepared.tree.order[c];
      if (evaluator_.coverage().is_covered(i) ||
          evaluator_.region(i) != evaluator_.region(patch_)) {
        continue;
      }
      const auto parts = evaluator_.coverage().open.find(i);
      if (parts == evaluator_.coverage().open.end()) {
        result[i] = entry(i, prepared.polygons[i], *kept, worker);
      } else {
        for (const ConvexPolygon& part : parts->second) {
          result[i] += entry(i, part, *kept, worker);
        }
      }
    }
  }

  double entry(std::int32_t i, const ConvexPolygon& part, const Candidates& candidates,
               ExchangeEvaluator::Worker& worker) const {
    const PreparedMesh& prepared = evaluator_.prepared();
    const auto in_front = [&](const ConvexPolygon& polygon, const HalfSpace& plane) {
      return clip_to_half_space(polygon.points(), plane.normal * plane.offset, plane.normal,
                                prepared.thickness);
    };
    const ConvexPolygon own = in_front(part, plane_);
    const ConvexPolygon other = in_front(polygon_, prepared.planes[i]);
    if (own.size() < 3 || other.size() < 3) return 0;
    const auto unoccluded = [&] {
      return exchange_area(own.points(), other.points(), kKernelTolerance);
    };
    evaluator_.find_blockers({own, prepared.planes[i]}, {other, plane_}, candidates, worker);
    if (worker.blockers.empty()) return unoccluded();
    return worker.estimator
        .estimate({own, prepared.planes[i], other, plane_, i, patch_}, worker.blockers, unoccluded,
                  pair_seed(seed_, i, patch_))
        .value;
  }

  const ExchangeEvaluator& evaluator_;
  const ConvexPolygon& polygon_;
  std::int32_t patch_;
  const HalfSpace& plane_;
  std::uint64_t seed_;
  Cluster cluster_;
  OccludedPairOptions options_;
};

}  // namespace

Eigen::VectorXd polygon_exchange(const ExchangeEvaluator& evaluator, const ConvexPolygon& polygon,
                                 std::int32_t patch, double tolerance, std::uint64_t seed,
                                 const Progress& progress) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(evaluator.size());
  const std::vector<std::int32_t> parts =
      largest_clusters(evaluator.tree(), evaluator.size() / kParts);
  const PolygonRow row(evaluator, polygon, patch, tolerance, seed);
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    progress.check();
    row.visit(parts[k], result);
  });
  return result;
}

}  // namespace radiosity
