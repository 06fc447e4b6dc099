#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/assembly/balance.h"
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
  /// Excludes the entries of the rows with mask 0 from change.
  virtual void freeze(const Eigen::VectorXd& mask) = 0;
};

/// What the closure correction did.
struct ClosureCorrection {
  std::vector<Index> open_rows;  ///< rows too far from closed to be an error; left as they are
  RowSums sums;                  ///< wanted are the areas; the mask is 0 in open rows
};

/// Whether every row sum equals its area (m²) within what the entries' errors explain and the
/// relative error that was asked of the form factors, `tolerance`.
bool is_closed_within_errors(const UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                             const Eigen::VectorXd& areas, double tolerance);

/// Changes the uncertain entries so that each row sums to its area, m²: the symmetric change of
/// least weighted squares Σ (ΔG_ij/σ_ij)². Certain entries and rows whose deficit no sampling error
/// explains stay as they are; of these, the rows count as open that is_closed_within_errors() does
/// not let pass. In at most `n_rounds` rounds (balance_rows). (van Leersum 1989, weighted)
ClosureCorrection correct_closure(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                                  const Eigen::VectorXd& areas, double tolerance,
                                  int n_rounds = kBalanceRounds);

}  // namespace radiosity
