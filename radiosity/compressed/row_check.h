#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {

/// Gathered light of some rows, with entries more exact than an operator's and samples of their
/// own, to tell how far off it is.
class RowCheck {
 public:
  /// `areas` are the patches', m²; `told` what each row of F 1 may be off by; `radiosity` holds
  /// fields, n x k, in the order of the patches: the first is 1, others have values of at least 0,
  /// or signs. All are copied but the evaluator, which must outlive this.
  RowCheck(const ExchangeEvaluator& evaluator, const std::vector<double>& areas,
           const Eigen::VectorXd& told, Eigen::MatrixXd radiosity, std::uint64_t seed,
           Ranks* ranks = nullptr);

  /// Evaluates so many rows more: a third of them spread evenly over the area, the others over the
  /// square of what rows may be off by, for a few patches beside blockers can have most of it.
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
  /// The same of as many rows as it takes to tell whether it is within a tolerance: 96 at least,
  /// and up to 384.
  Error decide(const Eigen::MatrixXd& gathered, double tolerance, const Progress& progress);

 private:
  const ExchangeEvaluator& evaluator_;
  std::vector<double> areas_;
  std::vector<double> shares_;  // of the rows up to each, in the tree's order
  Eigen::MatrixXd radiosity_;
  std::uint64_t seed_;
  Ranks* ranks_;                    // that share the rows, if there are any
  std::vector<std::int32_t> rows_;  // patches
  std::vector<double> weights_;     // of the rows: their share of the area over that of the rows
  std::vector<Eigen::VectorXd> gathered_;
};

/// What each row of F 1 may be off by if the errors of its blocks are alike, n, in the order of the
/// patches: what rows are chosen by.
Eigen::VectorXd likely_errors(const CompressedTransport& transport);

}  // namespace radiosity
