#pragma once

#include <optional>
#include <vector>

#include "radiosity/assembly_report.h"
#include "radiosity/exchange_assembly.h"
#include "radiosity/tile_totals.h"

namespace radiosity {

/// Keeps the tiles in memory.
class MemorySink final : public TileSink {
 public:
  MemorySink(const std::vector<double>& areas, const Eigen::VectorXd& covered)
      : areas_(areas), covered_(covered) {}

  void start(const TileLayout& layout) override {
    order_ = layout.order;
    tiles_.emplace(layout.strips);
    totals_.emplace(layout, areas_);
  }
  [[nodiscard]] bool has(Index, Index) const override { return false; }
  void put(ExchangeTile tile) override {
    totals_->add(tile);
    tiles_->set(std::move(tile));
  }

  Assembly finish() {
    const Eigen::VectorXd row_sums = totals_->row_sums();
    AssemblyReport report = make_report(totals_->census(), row_sums, order_, areas_, covered_);
    return {std::move(order_), std::move(*tiles_), row_sums, std::move(report)};
  }

 private:
  const std::vector<double>& areas_;
  const Eigen::VectorXd& covered_;
  std::vector<std::int32_t> order_;
  std::optional<ExchangeTiles> tiles_;
  std::optional<TileTotals> totals_;
};

}  // namespace radiosity
