#include "radiosity/assembly/closure.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Deficits beyond this many standard errors of the row, for independent entries, are holes and not
/// noise, unless entries that are all off the same way explain them: rules err alike nearby.
constexpr double kSigmas = 6;
/// Relative deficits below this are rounding and kernel error.
constexpr double kNegligible = 1e-6;
/// Rows so many times further from closed than that are still corrected: errors have long tails.
constexpr double kTail = 3;

/// Per row, whether the errors explain its distance from closed.
Eigen::Array<bool, Eigen::Dynamic, 1> are_explained(const UncertainExchange& exchange,
                                                    const Eigen::VectorXd& row_sums,
                                                    const Eigen::VectorXd& areas,
                                                    double negligible = kNegligible) {
  const Eigen::ArrayXd errors =
      kSigmas * exchange.row_variances().array().sqrt() + exchange.row_errors().array();
  return (areas - row_sums).array().abs() <= kTail * errors + negligible * areas.array();
}

}  // namespace

bool is_closed_within_errors(const UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                             const Eigen::VectorXd& areas, double tolerance) {
  return exchange.size() > 0 &&
         are_explained(exchange, row_sums, areas, kNegligible + tolerance).all();
}

ClosedRows correct_closure(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                           const Eigen::VectorXd& areas, double tolerance, int n_rounds) {
  const auto explained = are_explained(exchange, row_sums, areas).eval();
  const auto passing = are_explained(exchange, row_sums, areas, kNegligible + tolerance).eval();
  ClosedRows result{true, {}, {row_sums, areas, Eigen::VectorXd::Ones(exchange.size())}};
  for (Index i = 0; i < exchange.size(); ++i) {
    if (explained[i]) continue;
    if (!passing[i]) result.open_rows.push_back(i);
    result.sums.mask[i] = 0;
  }
  exchange.freeze(result.sums.mask);
  balance_rows(exchange, result.sums, n_rounds);
  for (Index i = 0; i < exchange.size(); ++i) {
    if (is_balanced(result.sums, i, exchange.rounding())) result.sums.present[i] = areas[i];
    if (result.sums.mask[i] == 0) result.sums.wanted[i] = result.sums.present[i];
  }
  return result;
}

Eigen::VectorXd limit_rows(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                           const Eigen::VectorXd& areas, double tolerance, int n_rounds) {
  const auto is_over = (row_sums.array() > (1 + tolerance) * areas.array() &&
                        are_explained(exchange, row_sums, areas))
                           .eval();
  if (!is_over.any()) return row_sums;
  exchange.freeze(Eigen::VectorXd::Ones(exchange.size()));  // nothing
  Eigen::VectorXd sums = row_sums;
  for (int round = 0; round < n_rounds; ++round) {
    const Eigen::ArrayXd excess = is_over.select((sums - areas).array().max(0), 0.0);
    if ((excess <= exchange.rounding() * areas.array()).all()) break;
    const Eigen::ArrayXd weights =
        exchange.weighted_sums(Eigen::VectorXd::Ones(exchange.size())).array();
    exchange.adjust((weights > 0).select(-excess / weights.max(1e-300), 0.0).matrix());
    sums = exchange.row_sums();
  }
  return sums;
}

ClosedRows close_rows(UncertainExchange& exchange, const Eigen::VectorXd& row_sums,
                      const Eigen::VectorXd& areas, Closed closed, double tolerance, int n_rounds) {
  const bool is_closed =
      closed == Closed::yes || (closed == Closed::automatic &&
                                is_closed_within_errors(exchange, row_sums, areas, tolerance));
  if (is_closed) return correct_closure(exchange, row_sums, areas, tolerance, n_rounds);
  const Eigen::VectorXd sums = limit_rows(exchange, row_sums, areas, tolerance, n_rounds);
  return {false, {}, {sums, sums, Eigen::VectorXd::Ones(exchange.size())}};
}

}  // namespace radiosity
