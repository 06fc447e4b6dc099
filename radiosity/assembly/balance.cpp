#include "radiosity/assembly/balance.h"

#include <cmath>

namespace radiosity {
namespace {

/// Steps of conjugate gradients in one round, and the relative residual that ends them sooner.
constexpr int kMaxSteps = 100;
constexpr double kSolved = 1e-6;
/// Added to the scaled matrix, of eigenvalues in [0, 2]: where two rows share their one entry and
/// lack different amounts there is no solution, and this gives the nearest.
constexpr double kRegular = 1e-9;
/// Row sums need no further round when they are this many roundings of an entry from what is
/// wanted.
constexpr double kRoundings = 2;

/// Solves (diag(W 1) + W) μ = d by conjugate gradients with diagonal scaling, as nearly as a
/// positive semidefinite matrix allows.
Eigen::VectorXd solve_multipliers(const AdjustableExchange& exchange,
                                  const Eigen::VectorXd& deficit) {
  const Eigen::VectorXd total = exchange.weighted_sums(Eigen::VectorXd::Ones(exchange.size()));
  const Eigen::VectorXd scale =
      (total.array() > 0).select(total.array().max(1e-300).rsqrt(), 0.0).matrix();
  const auto apply = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd mu = scale.cwiseProduct(x);
    const Eigen::VectorXd s = exchange.weighted_sums(mu) + total.cwiseProduct(mu);
    return Eigen::VectorXd(scale.cwiseProduct(s) + kRegular * x);
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(deficit.size());
  Eigen::VectorXd residual = scale.cwiseProduct(deficit);
  Eigen::VectorXd direction = residual;
  const double start = residual.squaredNorm();
  double square = start;
  for (int step = 0; step < kMaxSteps && square > kSolved * kSolved * start; ++step) {
    const Eigen::VectorXd image = apply(direction);
    const double curvature = direction.dot(image);
    if (curvature <= 0) break;
    const double length = square / curvature;
    x += length * direction;
    residual -= length * image;
    const double next = residual.squaredNorm();
    direction = residual + next / square * direction;
    square = next;
  }
  return scale.cwiseProduct(x);
}

bool are_balanced(const RowSums& sums, double rounding) {
  for (Index i = 0; i < sums.present.size(); ++i) {
    if (sums.mask[i] != 0 && !is_balanced(sums, i, rounding)) return false;
  }
  return true;
}

}  // namespace

bool is_balanced(const RowSums& sums, Index row, double rounding) {
  return std::abs(sums.wanted[row] - sums.present[row]) <= kRoundings * rounding * sums.wanted[row];
}

void balance_rows(AdjustableExchange& exchange, RowSums& sums, int n_rounds) {
  for (int round = 0; round < n_rounds && !are_balanced(sums, exchange.rounding()); ++round) {
    const Eigen::VectorXd deficit = sums.mask.cwiseProduct(sums.wanted - sums.present);
    exchange.adjust(solve_multipliers(exchange, deficit));
    sums.present = exchange.row_sums();
  }
}

}  // namespace radiosity
