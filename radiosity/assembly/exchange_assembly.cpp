#include "radiosity/assembly/exchange_assembly.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/exchange/occluded_pair.h"
#include "radiosity/exchange/pair_kernel.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/visibility/blocker_set.h"
#include "radiosity/visibility/cluster_tree.h"
#include "radiosity/visibility/cluster_visibility.h"
#include "radiosity/visibility/regions.h"

namespace radiosity {
namespace {

constexpr Index kTileSize = 64;
constexpr Index kLeafSize = 8;
/// Relative error of the unoccluded kernel, a matter of nanoseconds next to visibility.
constexpr double kKernelTolerance = 1e-7;
/// Share of the tolerance that it may use up.
constexpr double kKernelShare = 1e-4;
/// Up to this many patches it is exact: time is no matter there.
constexpr Index kExactPatches = 512;
constexpr double kExactTolerance = 1e-11;
/// Pairs that are tried, from so many patches on, so many for each and at most, to find what errors
/// they may have; what the sum of standard errors then aims at, in tolerances: the sum of true
/// errors is some 0.8 of it; and by how much a pair's may change.
constexpr std::int32_t kFewestTried = 256;
constexpr Index kTriedOfPatch = 3;
constexpr Index kMostTried = 8192;
constexpr std::uint64_t kTrialSeed = 0x7a11;
constexpr double kAim = 0.95;
constexpr double kLeastBudget = 0.3;
constexpr double kMostBudget = 3;
constexpr double kClutter = 0.15;
/// Exchange area of a pair on average, where every patch sees half of the others, m².
double mean_exchange_area(const PatchMesh& mesh) {
  const double area = std::accumulate(mesh.area.begin(), mesh.area.end(), 0.0);
  const auto n = static_cast<double>(std::max<Index>(mesh.size(), 1));
  return 2 * area / (n * n);
}

double kernel_tolerance(Index n_patches, double tolerance) {
  if (n_patches <= kExactPatches) return kExactTolerance;
  return std::max(std::min(kKernelTolerance, kKernelShare * tolerance), kExactTolerance);
}

class Assembler {
 public:
  Assembler(const PatchMesh& mesh, const Visibility& visibility, const TransportOptions& options,
            const Coverage& coverage)
      : options_(options),
        visibility_(visibility),
        table_(mesh, kernel_tolerance(mesh.size(), options.tolerance)),
        pair_options_{.tolerance = options.tolerance,
                      .mean_area = mean_exchange_area(mesh),
                      .thickness = table_.thickness(),
                      .kernel_tolerance = table_.tolerance()},
        coverage_(coverage) {
    const PatchMesh local = centered(mesh);
    tree_ = make_cluster_tree(local, kLeafSize, table_.thickness());
    blockers_ = make_blockers(local, table_.thickness());
    region_ = find_regions(mesh, visibility, table_.thickness());
    find_regions_of_clusters();
    find_strips();
    find_known();
    find_budget();
  }

  /// Makes the tiles that `sink` has not.
  void run(TileSink& sink) {
    sink_ = &sink;
    std::vector<Index> boundaries{0};
    for (const std::int32_t strip : strips_) boundaries.push_back(tree_.clusters[strip].end);
    sink.start({tree_.order, Strips(boundaries)});
    if (strips_.empty()) return;
    count_done();
    visit_blocks(0, 0, all_candidates(blockers_), false);
  }

 private:
  /// The largest clusters of at most kTileSize patches are the strips of the tiles.
  void find_strips() {
    strip_of_cluster_.assign(tree_.clusters.size(), -1);
    std::vector<std::int32_t> open;
    if (!tree_.clusters.empty()) open.push_back(0);
    while (!open.empty()) {
      const std::int32_t k = open.back();
      open.pop_back();
      const Cluster& cluster = tree_.clusters[k];
      if (cluster.end - cluster.begin <= kTileSize) {
        strip_of_cluster_[k] = static_cast<std::int32_t>(strips_.size());
        strips_.push_back(k);
      } else {
        open.push_back(cluster.right);
        open.push_back(cluster.left);
      }
    }
  }

  /// The region that all patches of a cluster look into, -1 if there are several.
  void find_regions_of_clusters() {
    for (const Cluster& cluster : tree_.clusters) {
      std::int32_t region = region_[tree_.order[cluster.begin]];
      for (Index k = cluster.begin + 1; k < cluster.end && region >= 0; ++k) {
        if (region_[tree_.order[k]] != region) region = -1;
      }
      region_of_cluster_.push_back(region);
    }
  }

  [[nodiscard]] bool are_apart(std::int32_t a, std::int32_t b) const {
    return region_of_cluster_[a] >= 0 && region_of_cluster_[b] >= 0 &&
           region_of_cluster_[a] != region_of_cluster_[b];
  }

  /// Marks the clusters of which an earlier operator had all patches.
  void find_known() {
    is_known_.assign(tree_.clusters.size(), false);
    if (options_.known.transport == nullptr) return;
    for (std::size_t k = 0; k < tree_.clusters.size(); ++k) {
      const Cluster& cluster = tree_.clusters[k];
      is_known_[k] =
          std::all_of(tree_.order.begin() + cluster.begin, tree_.order.begin() + cluster.end,
                      [this](std::int32_t patch) { return options_.known.patch[patch] >= 0; });
    }
  }

  /// A cluster of one patch.
  [[nodiscard]] Cluster alone(std::int32_t patch) const {
    Cluster cluster;
    for (const Vec3& corner : table_.polygon(patch)) {
      cluster.outline.push_back(corner);
      cluster.box.extend(corner);
    }
    cluster.plane = table_.plane(patch);
    return cluster;
  }

  /// The standard error of a pair as it would be computed, m².
  [[nodiscard]] double trial_error(std::int32_t i, std::int32_t j) const {
    if (i == j || coverage_.is_covered(i) || coverage_.is_covered(j)) return 0;
    if (region_[i] != region_[j]) return 0;
    const Blocking front_i = table_.in_front(i, j);
    const Blocking front_j = table_.in_front(j, i);
    if (front_i == Blocking::none || front_j == Blocking::none) return 0;
    const auto candidates = possible_blockers(alone(i), alone(j), blockers_,
                                              all_candidates(blockers_), table_.thickness());
    if (!candidates || candidates->empty()) return 0;
    TileWork work{0, 0, false, {}, OccludedPairEstimator(visibility_, pair_options_)};
    return occluded_entry(i, j, front_i, front_j, *candidates, work).error;
  }

  /// Tries some pairs, to see by how much the errors of all together would miss what is asked: few
  /// are partly hidden in one scene, many in another.
  void find_budget() {
    const auto n = static_cast<std::int32_t>(table_.size());
    if (n < kFewestTried) return;
    const Index n_tried = std::min<Index>(kTriedOfPatch * n, kMostTried);
    std::vector<double> errors(n_tried);
    parallel_for(n_tried, [&](std::ptrdiff_t k) {
      const auto place = static_cast<std::int32_t>(k);
      const auto pick = [&](std::int32_t which) {
        return static_cast<std::int32_t>(pair_seed(kTrialSeed, place, which) %
                                         static_cast<std::uint64_t>(n));
      };
      const std::int32_t a = pick(0);
      const std::int32_t b = pick(1);
      errors[k] = trial_error(std::min(a, b), std::max(a, b));
    });
    double sum = 0;
    for (const double error : errors) sum += error;
    const double mean = sum / static_cast<double>(n_tried);
    // Of all pairs, seen or not, the mean exchange area is half of that.
    const double asked = kAim * options_.tolerance * 0.5 * pair_options_.mean_area;
    // Where little is partly hidden it costs little, and errors stay as small as they come.
    if (mean < kClutter * asked) return;
    pair_options_.budget *= std::clamp(asked / mean, kLeastBudget, kMostBudget);
  }

  [[nodiscard]] bool is_strip(std::int32_t cluster) const {
    return strip_of_cluster_[cluster] >= 0;
  }

  /// Keeps the candidates that may block something between the clusters. Sets `is_hidden` if one
  /// blocks everything.
  [[nodiscard]] Candidates filter(std::int32_t a, std::int32_t b, const Candidates& candidates,
                                  bool& is_hidden) const {
    is_hidden = is_hidden || are_apart(a, b);
    if (is_hidden || (is_known_[a] && is_known_[b])) return {};
    const auto kept = possible_blockers(tree_.clusters[a], tree_.clusters[b], blockers_, candidates,
                                        table_.thickness());
    is_hidden = !kept;
    return kept.value_or(Candidates());
  }

  /// The strips that a cluster of at least one strip is made of, from first to last.
  [[nodiscard]] std::pair<Index, Index> strip_range(std::int32_t cluster) const {
    std::int32_t first = cluster;
    std::int32_t last = cluster;
    while (!is_strip(first)) first = tree_.clusters[first].left;
    while (!is_strip(last)) last = tree_.clusters[last].right;
    return {strip_of_cluster_[first], strip_of_cluster_[last]};
  }

  /// Whether the sink has all tiles between two clusters.
  [[nodiscard]] bool is_done(std::int32_t a, std::int32_t b) const {
    const auto [first_row, last_row] = strip_range(a);
    const auto [first_column, last_column] = strip_range(b);
    for (Index row = first_row; row <= last_row; ++row) {
      for (Index column = std::max(row, first_column); column <= last_column; ++column) {
        if (!sink_->has(row, column)) return false;
      }
    }
    return true;
  }

  /// Number of pairs between the patches of two strips.
  [[nodiscard]] double n_pairs(Index row_strip, Index column_strip) const {
    const auto rows = [this](Index strip) {
      const Cluster& cluster = tree_.clusters[strips_[strip]];
      return static_cast<double>(cluster.end - cluster.begin);
    };
    return row_strip == column_strip ? 0.5 * rows(row_strip) * (rows(row_strip) - 1)
                                     : rows(row_strip) * rows(column_strip);
  }

  /// Counts the pairs of the tiles that the sink has from the start.
  void count_done() {
    const auto n_strips = static_cast<Index>(strips_.size());
    for (Index column = 0; column < n_strips; ++column) {
      for (Index row = 0; row <= column; ++row) {
        if (sink_->has(row, column)) done_ += n_pairs(row, column);
      }
    }
    report_progress();
  }

  /// Descends to pairs of strips, in parallel.
  void visit_blocks(std::int32_t a, std::int32_t b, const Candidates& inherited, bool is_hidden) {
    if (is_done(a, b)) return;
    const Candidates candidates = filter(a, b, inherited, is_hidden);
    if (is_strip(a) && is_strip(b)) {
      make_tile(a, b, candidates, is_hidden);
      return;
    }
    const Cluster& ca = tree_.clusters[a];
    const Cluster& cb = tree_.clusters[b];
    std::vector<std::pair<std::int32_t, std::int32_t>> children;
    if (a == b) {
      children = {{ca.left, ca.left}, {ca.left, ca.right}, {ca.right, ca.right}};
    } else if (is_strip(b) || (!is_strip(a) && ca.end - ca.begin >= cb.end - cb.begin)) {
      children = {{ca.left, b}, {ca.right, b}};
    } else {
      children = {{a, cb.left}, {a, cb.right}};
    }
    parallel_for(static_cast<std::ptrdiff_t>(children.size()), [&](std::ptrdiff_t k) {
      visit_blocks(children[k].first, children[k].second, candidates, is_hidden);
    });
  }

  /// A tile under construction.
  struct TileWork {
    Index first_row;
    Index first_column;
    bool is_diagonal;
    Eigen::MatrixXd values;
    OccludedPairEstimator estimator;
    std::vector<const Blocker*> blockers{};
    std::vector<UncertainEntry> uncertain{};
    Census census{};
  };

  void make_tile(std::int32_t a, std::int32_t b, const Candidates& candidates, bool is_hidden) {
    options_.progress.check();
    const Cluster& ca = tree_.clusters[a];
    const Cluster& cb = tree_.clusters[b];
    TileWork work{ca.begin, cb.begin, a == b,
                  Eigen::MatrixXd::Zero(ca.end - ca.begin, cb.end - cb.begin),
                  OccludedPairEstimator(visibility_, pair_options_)};
    visit_pairs(a, b, candidates, is_hidden, work);
    const Index row_strip = strip_of_cluster_[a];
    const Index column_strip = strip_of_cluster_[b];
    sink_->put(
        {row_strip, column_strip, std::move(work.values), std::move(work.uncertain), work.census});
    const std::lock_guard lock(mutex_);
    done_ += n_pairs(row_strip, column_strip);
    report_progress();
  }

  void report_progress() const {
    if (!options_.progress.report) return;
    const auto n = static_cast<double>(table_.size());
    options_.progress.report("form factors", done_, 0.5 * n * (n - 1), "pairs");
  }

  /// Descends within a tile to the tree's leaves, filtering the candidates on the way.
  void visit_pairs(std::int32_t a, std::int32_t b, const Candidates& candidates, bool is_hidden,
                   TileWork& work) {
    if (are_averted(tree_.clusters[a], tree_.clusters[b], table_.thickness())) return;
    const Cluster& ca = tree_.clusters[a];
    const Cluster& cb = tree_.clusters[b];
    if (ca.is_leaf() && cb.is_leaf()) {
      for (Index r = ca.begin; r < ca.end; ++r) {
        for (Index c = a == b ? r + 1 : cb.begin; c < cb.end; ++c) {
          add_pair(r, c, candidates, is_hidden, work);
        }
      }
      return;
    }
    const auto descend = [&](std::int32_t child_a, std::int32_t child_b) {
      bool child_hidden = is_hidden;
      const Candidates kept = filter(child_a, child_b, candidates, child_hidden);
      visit_pairs(child_a, child_b, kept, child_hidden, work);
    };
    if (a == b) {
      descend(ca.left, ca.left);
      descend(ca.left, ca.right);
      descend(ca.right, ca.right);
    } else if (cb.is_leaf() || (!ca.is_leaf() && ca.end - ca.begin >= cb.end - cb.begin)) {
      descend(ca.left, b);
      descend(ca.right, b);
    } else {
      descend(a, cb.left);
      descend(a, cb.right);
    }
  }

  void add_pair(Index row, Index column, const Candidates& candidates, bool is_hidden,
                TileWork& work) {
    // Whichever cluster comes first, a pair is computed one way round.
    const std::int32_t i = std::min(tree_.order[row], tree_.order[column]);
    const std::int32_t j = std::max(tree_.order[row], tree_.order[column]);
    if (coverage_.is_covered(i) || coverage_.is_covered(j)) return;
    const Blocking front_i = table_.in_front(i, j);
    if (front_i == Blocking::none) return;
    const Blocking front_j = table_.in_front(j, i);
    if (front_j == Blocking::none) return;
    ++work.census.facing;
    if (region_[i] != region_[j]) {
      ++work.census.hidden;
      return;
    }
    if (const auto known = known_entry(i, j)) {
      ++work.census.known;
      store(row - work.first_row, column - work.first_column, *known, work);
      return;
    }
    if (is_hidden) {
      ++work.census.hidden;
      return;
    }
    const bool are_whole = !coverage_.open.contains(i) && !coverage_.open.contains(j);
    const Entry entry = !are_whole ? entry_in_parts(i, j, candidates, work)
                        : candidates.empty()
                            ? Entry{table_.unoccluded(i, j, front_i, front_j), 0, true}
                            : occluded_entry(i, j, front_i, front_j, candidates, work);
    if (are_whole && candidates.empty()) ++work.census.visible;
    store(row - work.first_row, column - work.first_column, entry, work);
  }

  struct Entry {
    double value;
    double error;
    bool is_certain;
  };

  /// The entry of two patches that an earlier operator had.
  [[nodiscard]] std::optional<Entry> known_entry(std::int32_t i, std::int32_t j) const {
    if (options_.known.transport == nullptr) return std::nullopt;
    const std::int32_t earlier_i = options_.known.patch[i];
    const std::int32_t earlier_j = options_.known.patch[j];
    if (earlier_i < 0 || earlier_j < 0) return std::nullopt;
    const PairFactor pair = options_.known.transport->pair(earlier_i, earlier_j);
    return Entry{pair.exchange_area, pair.error, pair.is_certain};
  }

  static void store(Index r, Index c, const Entry& entry, TileWork& work) {
    work.values(r, c) = entry.value;
    if (work.is_diagonal) work.values(c, r) = entry.value;
    if (entry.is_certain) return;
    const auto add = [&](Index row, Index column) {
      work.uncertain.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(column),
                                static_cast<float>(entry.error)});
    };
    add(r, c);
    if (work.is_diagonal) add(c, r);
  }

  /// The candidates' blockers but for those that lie wholly behind one of the patches.
  void find_blockers(std::int32_t i, std::int32_t j, const Candidates& candidates,
                     TileWork& work) const {
    const auto is_behind = [this](const Blocker& blocker, const HalfSpace& plane) {
      const double most = plane.offset + table_.thickness();
      return std::all_of(blocker.corners.begin(), blocker.corners.end(),
                         [&](const Vec3& corner) { return plane.normal.dot(corner) <= most; });
    };
    work.blockers.clear();
    for (const std::int32_t k : candidates) {
      const Blocker& blocker = blockers_.blocker(k);
      if (is_behind(blocker, table_.plane(i)) || is_behind(blocker, table_.plane(j))) continue;
      work.blockers.push_back(&blocker);
    }
  }

  /// An entry that some candidate may block.
  [[nodiscard]] Entry occluded_entry(std::int32_t i, std::int32_t j, Blocking front_i,
                                     Blocking front_j, const Candidates& candidates,
                                     TileWork& work) const {
    const auto part_in_front = [&](std::int32_t patch, std::int32_t of, Blocking front) {
      const ConvexPolygon& polygon = table_.polygon(patch);
      const HalfSpace& plane = table_.plane(of);
      return front == Blocking::all
                 ? polygon
                 : clip_to_half_space(polygon.points(), plane.normal * plane.offset, plane.normal,
                                      table_.thickness());
    };
    const ConvexPolygon polygon_i = part_in_front(i, j, front_j);
    const ConvexPolygon polygon_j = part_in_front(j, i, front_i);
    find_blockers(i, j, candidates, work);
    if (work.blockers.empty()) {
      ++work.census.visible;
      return {table_.unoccluded(i, j, front_i, front_j), 0, true};
    }
    const PairEstimate estimate = work.estimator.estimate(
        {polygon_i, table_.plane(i), polygon_j, table_.plane(j), i, j}, work.blockers,
        [&] { return table_.unoccluded(i, j, front_i, front_j); }, pair_seed(options_.seed, i, j));
    return counted(estimate, work);
  }

  static Entry counted(const PairEstimate& estimate, TileWork& work) {
    work.census.visible += estimate.blocking == Blocking::none ? 1 : 0;
    work.census.hidden += estimate.blocking == Blocking::all ? 1 : 0;
    work.census.undecided += estimate.blocking == Blocking::some ? 1 : 0;
    work.census.partial += estimate.is_partial ? 1 : 0;
    work.census.rays += estimate.rays;
    return {estimate.value, estimate.error, estimate.blocking != Blocking::some};
  }

  /// The parts of patch i that nothing covers, in front of patch j.
  [[nodiscard]] std::vector<ConvexPolygon> open_parts(std::int32_t i, std::int32_t j) const {
    const HalfSpace& plane = table_.plane(j);
    const auto parts = coverage_.open.find(i);
    const std::span<const ConvexPolygon> all =
        parts == coverage_.open.end() ? std::span(&table_.polygon(i), 1) : std::span(parts->second);
    std::vector<ConvexPolygon> result;
    for (const ConvexPolygon& part : all) {
      const ConvexPolygon seen = clip_to_half_space(part.points(), plane.normal * plane.offset,
                                                    plane.normal, table_.thickness());
      if (seen.size() >= 3) result.push_back(seen);
    }
    return result;
  }

  /// An entry of patches that solids cover in part.
  [[nodiscard]] Entry entry_in_parts(std::int32_t i, std::int32_t j, const Candidates& candidates,
                                     TileWork& work) const {
    find_blockers(i, j, candidates, work);
    PairEstimate sum;
    double variance = 0;
    bool all_visible = true;
    bool all_hidden = true;
    std::uint64_t seed = pair_seed(options_.seed, i, j);
    for (const ConvexPolygon& part_i : open_parts(i, j)) {
      for (const ConvexPolygon& part_j : open_parts(j, i)) {
        const auto unoccluded = [&] {
          return exchange_area(part_i.points(), part_j.points(), table_.tolerance());
        };
        const PairEstimate estimate =
            work.estimator.estimate({part_i, table_.plane(i), part_j, table_.plane(j), i, j},
                                    work.blockers, unoccluded, ++seed);
        sum.value += estimate.value;
        sum.rays += estimate.rays;
        sum.is_partial |= estimate.is_partial;
        variance += estimate.error * estimate.error;
        all_visible &= estimate.blocking == Blocking::none;
        all_hidden &= estimate.blocking == Blocking::all;
      }
    }
    sum.error = std::sqrt(variance);
    sum.blocking = all_hidden ? Blocking::all : all_visible ? Blocking::none : Blocking::some;
    return counted(sum, work);
  }

  const TransportOptions& options_;
  const Visibility& visibility_;
  PatchTable table_;
  OccludedPairOptions pair_options_;
  ClusterTree tree_;
  BlockerSet blockers_;
  const Coverage& coverage_;
  std::vector<std::int32_t> region_;  // per patch
  std::vector<std::int32_t> region_of_cluster_;
  std::vector<std::int32_t> strips_;            // clusters
  std::vector<std::int32_t> strip_of_cluster_;  // per cluster, or -1
  std::vector<bool> is_known_;                  // per cluster
  TileSink* sink_ = nullptr;
  std::mutex mutex_;  // guards the following
  double done_ = 0;   // pairs
};

}  // namespace

void assemble_tiles(const PatchMesh& mesh, const Visibility& visibility,
                    const TransportOptions& options, const Coverage& coverage, TileSink& sink) {
  Assembler(mesh, visibility, options, coverage).run(sink);
}

}  // namespace radiosity
