#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/assembly/balance.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/geometry.h"

namespace radiosity {

/// Exchange areas of which some are uncertain: the weight of an entry is its variance σ_ij², so
/// that only uncertain entries change.
class UncertainExchange : public AdjustableExchange {
 public:
  /// Σ_j σ_ij² over all entries, m⁴, n.
  [[nodiscard]] virtual Eigen::VectorXd row_variances() const = 0;
  /// Σ_j σ_ij over all entries, m², n.
  [[nodiscard]] virtual Eigen::VectorXd row_errors() const = 0;
  /// Excludes the entries of the rows with mask 0 from change, until the end of the correction.
  virtual void freeze(const Eigen::VectorXd& mask) = 0;
};

/// Changes an uncertain entry by its share of one round of the correction, σ² times the sum of its
/// row's and its column's factor. False if it fell below 0: it is 0 and may not change any more.
inline bool change_entry(double& value, double error, double factors) {
  value += error * error * factors;
  if (value >= 0) return true;
  value = 0;
  return false;
}

/// What closing the rows did.
struct ClosedRows {
  bool is_closed = false;          ///< whether the scene was taken as closed
  std::vector<Index> open_rows{};  ///< rows too far from closed to be an error; left as they are
  /// Wanted are the areas, and what there is in rows that stay as they are, whose mask is 0. Of
  /// scenes that are not closed, what there is in all of them.
  RowSums sums{};
};

/// Whether every row sum equals its area (m²) within what the entries' errors explain and the
/// relative error that was asked of the form factors, `tolerance`.
bool is_closed_within_errors(const UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                             const Eigen::VectorXd& areas, double tolerance);

/// Changes the uncertain entries so that each row sums to its area, m²: the symmetric change of
/// least weighted squares Σ (ΔG_ij/σ_ij)². Certain entries and rows whose deficit no sampling error
/// explains stay as they are; of these, the rows count as open that is_closed_within_errors() does
/// not let pass. In at most `n_rounds` rounds (balance_rows). (van Leersum 1989, weighted)
ClosedRows correct_closure(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                           const Eigen::VectorXd& areas, double tolerance,
                           int n_rounds = kBalanceRounds);

/// Lowers the uncertain entries of rows whose sum is above their area, m², by more than the
/// relative `tolerance` until none of them is above it: no patch has more around it than all
/// directions. Each in proportion to its variance; rows whose excess no error explains stay as they
/// are. Returns the sums then.
Eigen::VectorXd limit_rows(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                           const Eigen::VectorXd& areas, double tolerance,
                           int n_rounds = kBalanceRounds);

/// Corrects the rows if the scene is said, or found, to be closed, and otherwise limits them:
/// wherever the exchange areas are kept, this decides.
ClosedRows close_rows(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                      const Eigen::VectorXd& areas, Closed closed, double tolerance,
                      int n_rounds = kBalanceRounds);

}  // namespace radiosity
