#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/compressed/cluster_shapes.h"
#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {

/// Gathered light of some rows, with entries more exact than an operator's and samples of their
/// own, to tell how far off it is.
class RowCheck {
 public:
  /// `areas` are the patches', m²; `radiosity` holds fields, n x k, in the order of the patches:
  /// the first is 1, others have values of at least 0, or signs. Both are copied; the others
  /// must outlive this.
  RowCheck(const ExchangeEvaluator& evaluator, const ClusterShapes& shapes,
           const std::vector<double>& areas, Eigen::MatrixXd radiosity, std::uint64_t seed);

  /// Evaluates so many rows more, spread evenly over the area.
  void add_rows(Index n, const Progress& progress);
  [[nodiscard]] Index n_rows() const { return static_cast<Index>(rows_.size()); }
  [[nodiscard]] const Eigen::MatrixXd& radiosity() const { return radiosity_; }

  /// What F B is off by, for an operator that gives `gathered`, n x k: the root of the mean square
  /// over all area, relative to that of F B, or of F 1 if B has signs; the largest over the fields.
  struct Error {
    double estimate = 0;
    double limit = 0;  ///< no larger with 95 % confidence, allowing for the samples' skewness
    Index n_rows = 0;
  };
  [[nodiscard]] Error error(const Eigen::MatrixXd& gathered) const;

 private:
  const ExchangeEvaluator& evaluator_;
  const ClusterShapes& shapes_;
  std::vector<double> areas_;
  Eigen::MatrixXd radiosity_;
  std::uint64_t seed_;
  std::vector<std::int32_t> rows_;  // patches
  std::vector<Eigen::VectorXd> gathered_;
};

}  // namespace radiosity
