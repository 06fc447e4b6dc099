#include "radiosity/assembly/exchange_assembly.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/assembly/block_walk.h"
#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {
namespace {

/// Several errors of one entry become one: those of its images are independent.
void merge_uncertain(std::vector<UncertainEntry>& entries) {
  const auto place = [](const UncertainEntry& entry) { return std::pair(entry.row, entry.column); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const auto& a, const auto& b) { return place(a) < place(b); });
  std::size_t n = 0;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (n > 0 && place(entries[n - 1]) == place(entries[k])) {
      entries[n - 1].error = std::hypot(entries[n - 1].error, entries[k].error);
    } else {
      entries[n++] = entries[k];
    }
  }
  entries.resize(n);
}

/// Makes dense tiles of the exchange matrix; entries are sums over the images of their column.
class TileMaker final : public BlockVisitor {
 public:
  TileMaker(const ExchangeEvaluator& evaluator, const Progress& progress, TileSink& sink)
      : evaluator_(evaluator), progress_(progress), sink_(sink) {
    find_strips();
    sink.start(tile_layout(evaluator.tree()));
    if (!strips_.empty()) count_done();
  }

  [[nodiscard]] bool is_whole(std::int32_t cluster) const override {
    return strip_of_cluster_[cluster] >= 0;
  }

  /// Whether the sink lacks tiles between two clusters.
  [[nodiscard]] bool wants(std::int32_t a, std::int32_t b) const override {
    const auto [first_row, last_row] = strip_range(a);
    const auto [first_column, last_column] = strip_range(b);
    for (Index row = first_row; row <= last_row; ++row) {
      for (Index column = std::max(row, first_column); column <= last_column; ++column) {
        if (sink_.owns(row, column) && !sink_.has(row, column)) return true;
      }
    }
    return false;
  }

  void visit(std::int32_t a, std::int32_t b, std::span<const Between> between) override {
    progress_.check();
    const Cluster& ca = cluster(a);
    const Cluster& cb = cluster(b);
    ExchangeTile tile;
    tile.row_strip = strip_of_cluster_[a];
    tile.column_strip = strip_of_cluster_[b];
    tile.values = Eigen::MatrixXd::Zero(ca.end - ca.begin, cb.end - cb.begin);
    ExchangeEvaluator::Worker worker = evaluator_.worker();
    const auto set = [&](Index row, Index column, const ExchangeArea& entry) {
      tile.values(row, column) += entry.value;
      if (entry.is_certain) return;
      tile.uncertain.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(column),
                                static_cast<float>(entry.error)});
    };
    for (std::size_t g = 0; g < between.size(); ++g) {
      const std::int32_t image = evaluator_.tree().image(b, g);
      const Index first = cluster(image).begin;
      evaluator_.visit_block(a, image, between[g], worker,
                             [&](Index r, Index c, const ExchangeArea& entry) {
                               const Index row = r - ca.begin;
                               const Index column = c - first;
                               set(row, column, entry);
                               if (a == b && row != column) set(column, row, entry);
                             });
    }
    if (between.size() > 1) merge_uncertain(tile.uncertain);
    tile.census = worker.census;
    const double n = n_pairs(tile.row_strip, tile.column_strip);
    sink_.put(std::move(tile));
    const std::lock_guard lock(mutex_);
    done_ += n;
    report_progress();
  }

 private:
  [[nodiscard]] const Cluster& cluster(std::int32_t k) const {
    return evaluator_.tree().clusters[k];
  }

  void find_strips() {
    strips_ = largest_clusters(evaluator_.tree(), kTileSize);
    strip_of_cluster_.assign(evaluator_.tree().clusters.size(), -1);
    for (std::size_t strip = 0; strip < strips_.size(); ++strip) {
      strip_of_cluster_[strips_[strip]] = static_cast<std::int32_t>(strip);
    }
  }

  /// The strips that a cluster of at least one strip is made of, from first to last.
  [[nodiscard]] std::pair<Index, Index> strip_range(std::int32_t k) const {
    std::int32_t first = k;
    std::int32_t last = k;
    while (!is_whole(first)) first = cluster(first).left;
    while (!is_whole(last)) last = cluster(last).right;
    return {strip_of_cluster_[first], strip_of_cluster_[last]};
  }

  /// Number of pairs between the patches of two strips.
  [[nodiscard]] double n_pairs(Index row_strip, Index column_strip) const {
    const auto rows = [this](Index strip) {
      const Cluster& its = cluster(strips_[strip]);
      return static_cast<double>(its.end - its.begin);
    };
    return row_strip == column_strip ? 0.5 * rows(row_strip) * (rows(row_strip) - 1)
                                     : rows(row_strip) * rows(column_strip);
  }

  /// Counts the pairs of the tiles that the sink wants, and of those that it has from the start.
  void count_done() {
    const auto n_strips = static_cast<Index>(strips_.size());
    for (Index column = 0; column < n_strips; ++column) {
      for (Index row = 0; row <= column; ++row) {
        if (!sink_.owns(row, column)) continue;
        total_ += n_pairs(row, column);
        if (sink_.has(row, column)) done_ += n_pairs(row, column);
      }
    }
    report_progress();
  }

  void report_progress() const {
    if (!progress_.report) return;
    progress_.report("form factors", done_, total_, "pairs");
  }

  const ExchangeEvaluator& evaluator_;
  const Progress& progress_;
  TileSink& sink_;
  std::vector<std::int32_t> strips_;            // clusters
  std::vector<std::int32_t> strip_of_cluster_;  // per cluster, or -1
  double total_ = 0;                            // pairs
  std::mutex mutex_;                            // guards the following
  double done_ = 0;
};

}  // namespace

TileLayout tile_layout(const ClusterTree& tree) {
  std::vector<Index> boundaries{0};
  for (const std::int32_t strip : largest_clusters(tree, kTileSize)) {
    boundaries.push_back(tree.clusters[strip].end);
  }
  const auto part_end = tree.order.begin() + tree.part_size();
  return {{tree.order.begin(), part_end}, Strips(std::move(boundaries))};
}

void assemble_tiles(const WholeMesh& whole, const Visibility& visibility,
                    const TransportOptions& options, const Coverage& coverage, TileSink& sink) {
  const bool is_part = whole.n_parts() > 1;  // whose earlier entries are sums over images
  const ExchangeEvaluator evaluator(whole.mesh(), visibility, coverage,
                                    {.tolerance = options.tolerance,
                                     .seed = options.seed,
                                     .known = is_part ? KnownPairs{} : options.known,
                                     .n_parts = whole.n_parts()});
  TileMaker maker(evaluator, options.progress, sink);
  walk_blocks(evaluator, maker);
}

}  // namespace radiosity
