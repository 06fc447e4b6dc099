#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/geometry.h"

namespace radiosity {

/// The standard error of one uncertain entry of a tile.
struct UncertainEntry {
  std::uint16_t row;  ///< within the tile
  std::uint16_t column;
  float error;  ///< one sigma of G_ij, m²; its sign is ExchangeTiles' own
};

/// Symmetric matrix of exchange areas in dense tiles, of which only the upper triangle exists. Rows
/// are in an order that makes tiles of neighbouring patches; blocks that are wholly 0 are not kept.
/// Entries are float64 up to a few hundred patches, else float32 (relative rounding 6e-8); a
/// float64 diagonal then keeps the row sums exact.
class ExchangeTiles {
 public:
  /// Rows are split at `boundaries` (first 0, last n) into strips of at most 65535 rows.
  explicit ExchangeTiles(std::vector<Index> boundaries);

  [[nodiscard]] Index size() const { return boundaries_.back(); }
  [[nodiscard]] Index n_strips() const { return static_cast<Index>(boundaries_.size()) - 1; }
  [[nodiscard]] Index strip_begin(Index strip) const { return boundaries_[strip]; }
  [[nodiscard]] Index strip_size(Index strip) const {
    return boundaries_[strip + 1] - boundaries_[strip];
  }

  /// Stores the tile of two strips, row_strip <= column_strip. A diagonal tile must be symmetric
  /// and list its uncertain entries on both sides of the diagonal. Different tiles may be set from
  /// different threads at once.
  void set(Index row_strip, Index column_strip, const Eigen::MatrixXd& values,
           std::vector<UncertainEntry> uncertain);

  /// Excludes the uncertain entries of the rows with mask 0 from correction.
  void freeze(const Eigen::VectorXd& mask);
  /// Adds σ² (factors_i + factors_j) to each uncertain entry that is not frozen. One that would
  /// fall below 0 becomes 0 and frozen.
  void correct(const Eigen::VectorXd& factors);
  /// Ends the exclusion of all entries.
  void unfreeze();
  /// Σ_j σ_ij² x_j over entries that are not frozen, n.
  [[nodiscard]] Eigen::VectorXd free_error_product(const Eigen::VectorXd& x) const;

  /// Largest relative rounding of an entry as it is stored.
  [[nodiscard]] double rounding() const { return is_double_ ? 1e-14 : 6e-8; }

  /// Makes the row sums of `product` equal to `row_sums`, from which rounding has moved them.
  void set_row_sums(const Eigen::VectorXd& row_sums);

  /// G x for all columns of x, n x k. The same bits at any number of threads.
  [[nodiscard]] Eigen::MatrixXd product(const Eigen::MatrixXd& x) const;
  /// (σ∘σ) x for the squares of the standard errors, n x k.
  [[nodiscard]] Eigen::MatrixXd error_product(const Eigen::MatrixXd& x) const;
  /// Row i of G as stored, without what keeps the row sums exact, n.
  [[nodiscard]] Eigen::VectorXd row(Index i) const;
  /// Row i of the standard errors, n.
  [[nodiscard]] Eigen::VectorXd row_error(Index i) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Tile {
    std::unique_ptr<float[]> single;  ///< column-major entries, one of the two or neither
    std::unique_ptr<double[]> twice;
    std::vector<UncertainEntry> uncertain;  ///< error < 0 while frozen
  };

  template <typename Change>
  void change_uncertain(const Change& change);
  [[nodiscard]] Eigen::MatrixXd sum_variances(const Eigen::MatrixXd& x, bool with_frozen) const;
  [[nodiscard]] Index tile_index(Index row_strip, Index column_strip) const;
  [[nodiscard]] Eigen::MatrixXd values(const Tile& tile, Index rows, Index columns) const;
  void store(Tile& tile, const Eigen::MatrixXd& values) const;
  template <typename AddTile>
  [[nodiscard]] Eigen::MatrixXd sum_over_tiles(const Eigen::MatrixXd& x, const AddTile& add) const;

  std::vector<Index> boundaries_;
  std::vector<Tile> tiles_;
  Eigen::VectorXd diagonal_;
  bool is_double_;
};

}  // namespace radiosity
