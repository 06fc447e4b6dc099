#pragma once

#include <optional>
#include <vector>

#include "radiosity/assembly/assembly_report.h"
#include "radiosity/assembly/exchange_assembly.h"
#include "radiosity/assembly/exchange_matrix.h"
#include "radiosity/assembly/tile_totals.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Exchange areas of all pairs, in the order of a cluster tree.
struct Assembly {
  std::vector<std::int32_t> order;  ///< patch of each row
  ExchangeMatrix tiles;
  Eigen::VectorXd row_sums;  ///< Σ_j G_ij before rounding and correction, m², tree order
  AssemblyReport report;     ///< before correction
};

/// Keeps the tiles in memory.
class MemorySink final : public TileSink {
 public:
  /// Where there are `ranks`, of their shares only (TileShares::keeper).
  MemorySink(const std::vector<double>& areas, const Eigen::VectorXd& covered,
             Ranks* ranks = nullptr)
      : areas_(areas), covered_(covered), ranks_(ranks) {}

  void start(const TileLayout& layout) override {
    order_ = layout.order;
    tiles_.emplace(layout.strips, ranks_);
    totals_.emplace(layout, areas_);
  }
  [[nodiscard]] bool has(Index, Index) const override { return false; }
  void put(ExchangeTile tile) override {
    totals_->add(tile);
    tiles_->set(std::move(tile));
  }

  Assembly finish() {
    if (ranks_ != nullptr) totals_->add_over(*ranks_);
    const Eigen::VectorXd row_sums = totals_->row_sums();
    AssemblyReport report = make_report(totals_->census(), row_sums, order_, areas_, covered_);
    return {std::move(order_), std::move(*tiles_), row_sums, std::move(report)};
  }

 private:
  const std::vector<double>& areas_;
  const Eigen::VectorXd& covered_;
  Ranks* ranks_;
  std::vector<std::int32_t> order_;
  std::optional<ExchangeMatrix> tiles_;
  std::optional<TileTotals> totals_;
};

/// assemble_tiles() into memory, or that of all ranks, of the patches of `mesh` in their whole;
/// `coverage` is the whole's.
Assembly assemble_exchange_areas(const PatchMesh& mesh, const WholeMesh& whole,
                                 const Visibility& visibility, const TransportOptions& options,
                                 const Coverage& coverage);

}  // namespace radiosity
