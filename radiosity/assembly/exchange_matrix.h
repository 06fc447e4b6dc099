#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/assembly/closure.h"
#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/ranks.h"
#include "radiosity/operator/transport.h"

namespace radiosity {

/// Symmetric matrix of exchange areas in dense tiles, of which only the upper triangle exists. Rows
/// are in an order that makes tiles of neighbouring patches; blocks that are wholly 0 are not kept.
/// Entries are float64 up to a few hundred patches, else float32 (relative rounding 6e-8); a
/// float64 diagonal then keeps the row sums exact. Where there are several ranks, each keeps the
/// tiles of its share of sums (SumParts); then all methods but `set` are called by all together,
/// and give all the same bits as one alone would have.
class ExchangeMatrix final : public UncertainExchange {
 public:
  explicit ExchangeMatrix(const Strips& strips, Ranks* ranks = nullptr);

  [[nodiscard]] Index size() const override { return strips_.n_rows(); }

  /// Stores a tile. Different tiles may be set from different threads at once.
  void set(ExchangeTile tile);
  /// Stores a row of G in tiles that are not set: entries on its diagonal tile and right of it,
  /// with their standard errors, both n. Rows of one strip may not be set from different threads.
  void set_row(Index i, const Eigen::VectorXd& values, const Eigen::VectorXd& errors);

  void freeze(const Eigen::VectorXd& mask) override;
  void adjust(const Eigen::VectorXd& factors) override;
  [[nodiscard]] Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const override;
  [[nodiscard]] Eigen::VectorXd row_variances() const override;
  [[nodiscard]] Eigen::VectorXd row_errors() const override;
  [[nodiscard]] Eigen::VectorXd row_sums() const override;
  [[nodiscard]] double rounding() const override { return is_double_ ? 1e-14 : 6e-8; }

  /// Makes the row sums of `product` equal to `sums`, from which rounding has moved them. Ends a
  /// correction: all entries may change again.
  void set_row_sums(const Eigen::VectorXd& sums);

  /// G x for all columns of x, n x k. The same bits at any number of threads.
  [[nodiscard]] Eigen::MatrixXd product(const Eigen::MatrixXd& x) const;
  /// (σ∘σ) x for the squares of the standard errors, n x k.
  [[nodiscard]] Eigen::MatrixXd error_product(const Eigen::MatrixXd& x) const;
  /// Row i of G as stored, without what keeps the row sums exact, n.
  [[nodiscard]] Eigen::VectorXd row(Index i) const;
  /// Entry (i, j) as stored.
  [[nodiscard]] ExchangeArea entry(Index i, Index j) const;
  /// Row i of the standard errors, n.
  [[nodiscard]] Eigen::VectorXd row_error(Index i) const;
  /// Of this rank.
  [[nodiscard]] std::size_t bytes() const;

  /// What of row(i) is kept here, 0 elsewhere, n. By each rank for itself.
  [[nodiscard]] Eigen::VectorXd own_row(Index i) const;
  [[nodiscard]] const Strips& strips() const { return strips_; }
  [[nodiscard]] Ranks* ranks() const { return ranks_; }

 private:
  struct Tile {
    std::unique_ptr<float[]> single;  ///< column-major entries, one of the two or neither
    std::unique_ptr<double[]> twice;
    std::vector<UncertainEntry> uncertain;  ///< by column and row
    std::vector<bool> is_fixed;  ///< of these: may not change; empty unless under correction
    [[nodiscard]] bool may_change(std::size_t k) const { return is_fixed.empty() || !is_fixed[k]; }
  };

  template <typename Change>
  void change_uncertain(const Change& change);
  /// `product` without the diagonal, so many columns at once as a Block has.
  template <typename Block>
  [[nodiscard]] Eigen::MatrixXd product_by(const Eigen::MatrixXd& x) const;
  template <typename Term>
  [[nodiscard]] Eigen::MatrixXd sum_entries(const Eigen::MatrixXd& x, const Term& term) const;
  void store(Tile& tile, const Eigen::MatrixXd& values) const;
  void store_entry(Tile& tile, Index n_entries, Index place, double value) const;

  /// Where in `tiles_` a tile is, or -1 where another rank keeps it.
  [[nodiscard]] Index place_of(Index row_strip, Index column_strip) const;
  [[nodiscard]] const Tile* find(Index row_strip, Index column_strip) const {
    const Index place = place_of(row_strip, column_strip);
    return place < 0 ? nullptr : &tiles_[place];
  }
  [[nodiscard]] Tile* find(Index row_strip, Index column_strip) {
    const Index place = place_of(row_strip, column_strip);
    return place < 0 ? nullptr : &tiles_[place];
  }
  /// Adds up what all ranks have, of which one has each value.
  void unite(Eigen::VectorXd& values) const;

  Strips strips_;
  Ranks* ranks_;
  Index first_tile_;
  std::vector<Tile> tiles_;  // from the first one kept here on
  Eigen::VectorXd diagonal_;
  bool is_double_;
};

}  // namespace radiosity
