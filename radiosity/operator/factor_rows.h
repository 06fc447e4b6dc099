#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// The exchange area G_ij of two patches, as far as it is known.
struct ExchangeArea {
  double value = 0;        ///< m²
  double error = 0;        ///< one standard error, m²
  bool is_certain = true;  ///< no error but rounding
};

/// The form factors of n patches by rows and pairs, with their errors: of an operator that keeps
/// them, or of a file.
class FactorRows {
 public:
  virtual ~FactorRows() = default;
  /// Row i of F: the fractions of the power leaving patch i that reach each patch, n.
  [[nodiscard]] virtual Eigen::VectorXd row(Index i) const = 0;
  /// One standard error of each entry of row i, n; exactly 0 where the entry is certified.
  [[nodiscard]] virtual Eigen::VectorXd row_error(Index i) const = 0;
  /// The exchange area of patches i and j, as `row` gives it.
  [[nodiscard]] virtual ExchangeArea pair(Index i, Index j) const = 0;
};

}  // namespace radiosity
