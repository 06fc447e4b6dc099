#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/closure.h"
#include "radiosity/tile_store.h"

namespace radiosity {

/// The uncertain entries of a tile store, for the closure correction. The file is never changed:
/// what the rounds of the correction did to an entry follows from their factors, which are kept,
/// and is worked out anew whenever it is read. So memory does not grow with the number of entries.
class StoredClosure final : public UncertainExchange {
 public:
  /// Keeps the uncertain entries in memory if they fit into `memory` bytes, else reads them from
  /// the file each time. The result does not depend on it.
  StoredClosure(const TileStore& store, std::size_t memory);

  [[nodiscard]] Index size() const override { return strips().n_rows(); }
  [[nodiscard]] Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const override;
  void adjust(const Eigen::VectorXd& factors) override { rounds_.push_back(factors); }
  [[nodiscard]] Eigen::VectorXd row_sums() const override;
  [[nodiscard]] double rounding() const override;
  [[nodiscard]] Eigen::VectorXd row_variances() const override;
  void freeze(const Eigen::VectorXd& mask) override { mask_ = mask; }

  /// Gives back the memory for the entries.
  void release_memory();
  [[nodiscard]] const Strips& strips() const { return store_.layout().strips; }
  /// A tile as the correction has left it.
  [[nodiscard]] ExchangeTile tile(Index row_strip, Index column_strip) const;

 private:
  /// Where an entry stands after all rounds.
  struct State {
    double value;
    bool is_free;
  };

  void load();
  template <typename Visit>
  void visit_tile(Index row_strip, Index column_strip, const Visit& visit) const;
  template <typename Term>
  [[nodiscard]] Eigen::VectorXd sum_entries(const Eigen::VectorXd& x, const Term& term) const;
  [[nodiscard]] State replay(const RecordedEntry& entry, Index i, Index j, bool is_zero_tile) const;

  const TileStore& store_;
  Eigen::VectorXd mask_;
  std::vector<Eigen::VectorXd> rounds_;  // factors of each
  bool is_loaded_ = false;
  std::vector<RecordedEntry> entries_;  // if loaded: of all tiles, by number of tile
  std::vector<std::int64_t> starts_;    // if loaded: per tile, and the end
  std::vector<bool> is_zero_;           // if loaded: per tile, as UncertainPart::is_zero
};

}  // namespace radiosity
