#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "radiosity/exchange/occluded_pair.h"
#include "radiosity/exchange/pair_kernel.h"
#include "radiosity/operator/census.h"
#include "radiosity/operator/known_pairs.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/cluster_visibility.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/prepared_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

struct EvaluatorOptions {
  double tolerance = 1e-2;  ///< relative error asked of the form factors, > 0
  std::uint64_t seed = 0;   ///< of the visibility samples
  KnownPairs known = {};    ///< from an operator that was not corrected to be closed
  Index n_parts = 1;        ///< the mesh is so many images of its first patches, and so is the tree
};

/// What is known of the pairs between two clusters.
struct Between {
  Candidates candidates;   ///< what may block
  bool is_hidden = false;  ///< proved: no patch sees one of the other cluster
};

/// Computes exchange areas, one by one or between two clusters: facing test and clipping, candidate
/// occluders inherited down the cluster tree, the exact kernel for pairs that are proved visible,
/// OccludedPairEstimator for the rest. Immutable; each thread has a Worker of its own. The entries
/// do not depend on the order in which they are asked for.
class ExchangeEvaluator {
 public:
  /// `coverage` is the mesh's. All must outlive this.
  ExchangeEvaluator(const PatchMesh& mesh, const Visibility& visibility, const Coverage& coverage,
                    const EvaluatorOptions& options);

  /// What one thread needs to evaluate entries, and what became of those that it did.
  struct Worker {
    OccludedPairEstimator estimator;
    std::uint64_t seed = 0;  // of visibility samples
    std::vector<const Blocker*> blockers{};
    std::vector<std::int32_t> groups{};  // of blockers, yet to be opened
    Census census{};
  };
  [[nodiscard]] Worker worker() const {
    return {OccludedPairEstimator(visibility_, pair_options_), options_.seed};
  }
  /// One whose entries have such a share of the errors that others have, and samples of their own:
  /// to check others by.
  [[nodiscard]] Worker checking_worker(double share) const;

  [[nodiscard]] Index size() const { return prepared_.size(); }
  [[nodiscard]] const ClusterTree& tree() const { return prepared_.tree; }
  [[nodiscard]] const PreparedMesh& prepared() const { return prepared_; }
  [[nodiscard]] const Visibility& visibility() const { return visibility_; }
  [[nodiscard]] const Coverage& coverage() const { return coverage_; }
  /// Patches of different regions do not see each other.
  [[nodiscard]] std::int32_t region(std::int32_t patch) const { return region_[patch]; }

  /// Whether nothing but blockers between makes the exchange with some patches of a cluster differ
  /// from that with others: they look into one region, and solids cover none.
  [[nodiscard]] bool is_uniform(std::int32_t cluster) const {
    return region_of_cluster_[cluster] >= 0 && !has_covered_[cluster];
  }

  /// What is known of the root and itself.
  [[nodiscard]] Between everything() const { return {all_candidates(prepared_.blockers)}; }
  /// What is known of two clusters, given what is of two that hold them.
  [[nodiscard]] Between narrowed(std::int32_t a, std::int32_t b, const Between& wider) const;

  /// What is known of two patches by themselves.
  [[nodiscard]] Between between(std::int32_t i, std::int32_t j) const;

  /// The exchange area of two patches, whichever comes first, given what is known of them or of
  /// clusters that hold them.
  [[nodiscard]] ExchangeArea entry(std::int32_t i, std::int32_t j, const Between& between,
                                   Worker& worker) const;

  /// The exchange area of two patches that see each other wholly, m².
  [[nodiscard]] double unoccluded(std::int32_t i, std::int32_t j) const {
    return kernel_.unoccluded(std::min(i, j), std::max(i, j), Blocking::all, Blocking::all);
  }

  /// Takes the exchange area of two places in the tree's order.
  using Visit = std::function<void(Index row, Index column, const ExchangeArea& entry)>;
  /// Visits the entries between two clusters that are not proved to be 0; of a cluster and itself,
  /// those above the diagonal, and of a cluster and its image in another part those on it, too.
  /// Descends to the tree's leaves, narrowing on the way.
  void visit_block(std::int32_t a, std::int32_t b, const Between& between, Worker& worker,
                   const Visit& visit) const;
  /// Takes the exchange area of a patch with the one at a place in the tree's order.
  using VisitOfRow = std::function<void(Index column, const ExchangeArea& entry)>;
  /// Visits the entries of a patch with all others that are not proved to be 0.
  void visit_row(std::int32_t patch, Worker& worker, const VisitOfRow& visit) const;

  /// What has a place in space and a plane that it faces away from.
  struct Placed {
    const ConvexPolygon& polygon;
    const HalfSpace& plane;
  };
  /// Finds the candidates' blockers for Worker::blockers but for those that lie wholly behind one
  /// of two polygons; of several together, those that may be between them.
  void find_blockers(const Placed& a, const Placed& b, const Candidates& candidates,
                     Worker& worker) const;

 private:
  /// Whether two clusters are images of each other, or the same.
  [[nodiscard]] bool are_images(const Cluster& a, const Cluster& b) const {
    return a.end - a.begin == b.end - b.begin && (b.begin - a.begin) % tree().part_size() == 0;
  }
  [[nodiscard]] Placed placed(std::int32_t patch) const {
    return {prepared_.polygons[patch], prepared_.planes[patch]};
  }
  void visit_row(std::int32_t patch, const Cluster& own, std::int32_t b, const Between& wider,
                 Worker& worker, const VisitOfRow& visit) const;
  /// A cluster of one patch.
  [[nodiscard]] Cluster alone(std::int32_t patch) const {
    return cluster_of(prepared_.polygons[patch], prepared_.planes[patch]);
  }
  void find_regions_of_clusters();
  void find_known_clusters();
  void find_budget();
  [[nodiscard]] Between filtered(const Cluster& a, const Cluster& b,
                                 const Candidates& candidates) const;
  [[nodiscard]] bool are_apart(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] double trial_error(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] std::optional<ExchangeArea> known_entry(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] ExchangeArea occluded_entry(std::int32_t i, std::int32_t j, Blocking front_i,
                                            Blocking front_j, const Candidates& candidates,
                                            Worker& worker) const;
  [[nodiscard]] std::vector<ConvexPolygon> open_parts(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] ExchangeArea entry_in_parts(std::int32_t i, std::int32_t j,
                                            const Candidates& candidates, Worker& worker) const;

  const Visibility& visibility_;
  const Coverage& coverage_;
  EvaluatorOptions options_;
  PreparedMesh prepared_;
  PairKernel kernel_;
  OccludedPairOptions pair_options_;
  std::vector<std::int32_t> region_;             // per patch
  std::vector<std::int32_t> region_of_cluster_;  // -1 where there are several
  std::vector<bool> has_covered_;                // per cluster
  std::vector<bool> is_known_;                   // per cluster: an earlier operator had all patches
};

}  // namespace radiosity
