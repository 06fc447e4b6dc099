#pragma once

#include <Eigen/Core>
#include <atomic>
#include <mutex>
#include <vector>

#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/ranks.h"

namespace radiosity {

/// Row sums and census of tiles that come from many threads, in any order: always the same bits.
class TileTotals {
 public:
  /// `areas` are those of the patches, m², n.
  TileTotals(const TileLayout& layout, const std::vector<double>& areas);

  /// Adds a tile. Callable from any thread.
  void add(const ExchangeTile& tile);

  /// Adds what the other ranks have. Called by all of them together.
  void add_over(Ranks& ranks);

  /// Σ_j G_ij over the tiles so far, m², in the order of the rows.
  [[nodiscard]] Eigen::VectorXd row_sums() const;
  [[nodiscard]] const Census& census() const { return census_; }

 private:
  void add_to_row(Index row, double exchange);

  Strips strips_;
  Eigen::VectorXd areas_;                        // in the order of the rows
  std::vector<std::atomic<std::int64_t>> sums_;  // Σ_j F_ij; integers add up without rounding
  std::mutex mutex_;                             // guards the census
  Census census_;
};

}  // namespace radiosity
