#pragma once

#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/stream/stored_closure.h"

namespace radiosity {

/// The exchange areas of a tile store as they go into the result: corrected for closure, without
/// the smallest pairs, and with rows balanced by changes in proportion to the entries (w_ij =
/// G_ij). As in StoredClosure the file stays as it is and the rounds are worked out anew.
class StoredBalance final : public AdjustableExchange {
 public:
  /// Drops the pairs whose F_ij and F_ji are both below `min_factor`. `areas` are those of the
  /// rows, m²; entries in rows with mask 0 are not balanced.
  StoredBalance(const StoredClosure& closure, Eigen::VectorXd areas, double min_factor,
                Eigen::VectorXd mask);

  [[nodiscard]] Index size() const override { return areas_.size(); }
  [[nodiscard]] Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const override;
  void adjust(const Eigen::VectorXd& factors) override { rounds_.push_back(factors); }
  [[nodiscard]] Eigen::VectorXd row_sums() const override;
  [[nodiscard]] double rounding() const override;
  /// Takes back the last `adjust`.
  void undo() { rounds_.pop_back(); }

  /// What was dropped, by row.
  struct Dropped {
    Eigen::VectorXd exchange;  ///< Σ_j G_ij, m²
    Eigen::VectorXd entries;   ///< their number
  };
  [[nodiscard]] Dropped dropped() const;

  [[nodiscard]] const Strips& strips() const { return closure_.strips(); }
  /// A tile of the result.
  [[nodiscard]] ExchangeTile tile(Index row_strip, Index column_strip) const;

 private:
  template <typename Keep>
  [[nodiscard]] ExchangeTile closed_tile(Index row_strip, Index column_strip,
                                         const Keep& keep) const;
  void scale(ExchangeTile& tile) const;
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& x) const;

  const StoredClosure& closure_;
  Eigen::VectorXd areas_;
  double min_factor_;
  Eigen::VectorXd mask_;
  std::vector<Eigen::VectorXd> rounds_;  // factors of each
};

}  // namespace radiosity
