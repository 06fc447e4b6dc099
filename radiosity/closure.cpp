#include "radiosity/closure.h"

#include <cmath>

namespace radiosity {
namespace {

/// Deficits beyond this many standard errors of the row are holes, not noise.
constexpr double kSigmas = 6;
/// Relative deficits below this are rounding and kernel error.
constexpr double kNegligible = 1e-6;

bool is_explained(double deficit, double variance, double area) {
  return std::abs(deficit) <= kSigmas * std::sqrt(variance) + kNegligible * area;
}

}  // namespace

bool is_closed_within_errors(const UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                             const Eigen::VectorXd& areas) {
  const Eigen::VectorXd variance = exchange.row_variances();
  for (Index i = 0; i < exchange.size(); ++i) {
    if (!is_explained(areas[i] - row_sums[i], variance[i], areas[i])) return false;
  }
  return exchange.size() > 0;
}

ClosureCorrection correct_closure(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                                  const Eigen::VectorXd& areas, int n_rounds) {
  const Eigen::VectorXd variance = exchange.row_variances();
  ClosureCorrection result{0, {row_sums, areas, Eigen::VectorXd::Ones(exchange.size())}};
  for (Index i = 0; i < exchange.size(); ++i) {
    if (is_explained(areas[i] - row_sums[i], variance[i], areas[i])) continue;
    ++result.n_open_rows;
    result.sums.mask[i] = 0;
  }
  exchange.freeze(result.sums.mask);
  balance_rows(exchange, result.sums, n_rounds);
  for (Index i = 0; i < exchange.size(); ++i) {
    if (is_balanced(result.sums, i, exchange.rounding())) result.sums.present[i] = areas[i];
  }
  return result;
}

}  // namespace radiosity
