#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// A symmetric matrix of exchange areas G_ij with a weight w_ij = w_ji >= 0 on each entry: how
/// readily it changes. Wherever the matrix is kept, row sums are mended by the same algorithm.
class AdjustableExchange {
 public:
  virtual ~AdjustableExchange() = default;
  /// Number of rows n.
  [[nodiscard]] virtual Index size() const = 0;
  /// Σ_j w_ij x_j over the entries that may change, n.
  [[nodiscard]] virtual Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const = 0;
  /// Adds w_ij (factors_i + factors_j) to each entry that may change. One that would fall below 0
  /// becomes 0 and may not change any more.
  virtual void adjust(const Eigen::VectorXd& factors) = 0;
  /// Σ_j G_ij, m², n.
  [[nodiscard]] virtual Eigen::VectorXd row_sums() const = 0;
  /// Relative rounding of an entry as it is stored, or what else is not worth a further round.
  [[nodiscard]] virtual double rounding() const = 0;
};

/// Row sums and what they shall become, m², n.
struct RowSums {
  Eigen::VectorXd present;
  Eigen::VectorXd wanted;
  Eigen::VectorXd mask;  ///< 1, or 0 for a row whose sum may be anything
};

/// Whether a row's sum is as near to what is wanted as the rounding of its entries allows.
bool is_balanced(const RowSums& sums, Index row, double rounding);

/// Rounds of balancing if nobody says otherwise.
inline constexpr int kBalanceRounds = 20;

/// Makes the row sums as wanted by the symmetric change of least weighted squares Σ ΔG_ij²/w_ij,
/// which is ΔG_ij = w_ij (μ_i + μ_j), in at most `n_rounds` rounds: entries that would fall below 0
/// stay there and leave the rest to the others in the next. Updates `sums.present`.
void balance_rows(AdjustableExchange& exchange, RowSums& sums, int n_rounds = kBalanceRounds);

}  // namespace radiosity
