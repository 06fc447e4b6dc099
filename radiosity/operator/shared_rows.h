#pragma once

#include <Eigen/Core>
#include <functional>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"

namespace radiosity {

/// The rows of an operator whose entries lie on several ranks, which all call these together.
class SharedRows {
 public:
  /// Takes rows of F, transposed: n x m, a column for each patch from `first` on.
  using Visitor = std::function<void(Index first, const Eigen::MatrixXd& rows)>;

  virtual ~SharedRows() = default;
  /// Visits the rows of this rank's share of the blocks of `block` patches that all patches make
  /// up, block by block (the last may have fewer), on many threads at once.
  virtual void visit_share(Index block, const Progress& progress, const Visitor& visit) const = 0;
  /// Fills in, of values with a row for each patch, those of the other ranks' shares.
  virtual void complete(Index block, Eigen::MatrixXd& values) const = 0;
};

}  // namespace radiosity
