#include "radiosity/closure.h"

#include <cmath>

namespace radiosity {
namespace {

/// Deficits beyond this many standard errors of the row are holes, not noise.
constexpr double kSigmas = 6;
/// Relative deficits below this are rounding and kernel error.
constexpr double kNegligible = 1e-6;
/// Steps of conjugate gradients in one round, and the relative residual that ends them sooner.
constexpr int kMaxSteps = 100;
constexpr double kSolved = 1e-6;
/// Entries that would fall below 0 stay there and leave the rest to others, in so many rounds.
constexpr int kMaxRounds = 20;
/// Row sums need no further round when they are this many roundings of an entry from 1; in single
/// precision they are then closed for good on the diagonal.
constexpr double kRoundings = 2;

Eigen::VectorXd row_variance(const ExchangeTiles& tiles) {
  return tiles.error_product(Eigen::VectorXd::Ones(tiles.size())).col(0);
}

bool is_explained(double deficit, double variance, double area) {
  return std::abs(deficit) <= kSigmas * std::sqrt(variance) + kNegligible * area;
}

/// Solves (diag(S 1) + S) μ = d, S = σ∘σ, by conjugate gradients with diagonal scaling. The matrix
/// is positive semidefinite; d is in its range or as near as rounding allows.
Eigen::VectorXd solve_multipliers(const ExchangeTiles& tiles, const Eigen::VectorXd& deficit) {
  const Eigen::VectorXd variance = tiles.free_error_product(Eigen::VectorXd::Ones(tiles.size()));
  const Eigen::VectorXd scale =
      (variance.array() > 0).select(variance.array().max(1e-300).rsqrt(), 0.0).matrix();
  const auto apply = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd mu = scale.cwiseProduct(x);
    const Eigen::VectorXd s = tiles.free_error_product(mu) + variance.cwiseProduct(mu);
    return Eigen::VectorXd(scale.cwiseProduct(s));
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

}  // namespace

bool is_closed_within_errors(const ExchangeTiles& tiles, const Eigen::VectorXd& row_sums,
                             const Eigen::VectorXd& areas) {
  const Eigen::VectorXd variance = row_variance(tiles);
  for (Index i = 0; i < tiles.size(); ++i) {
    if (!is_explained(areas[i] - row_sums[i], variance[i], areas[i])) return false;
  }
  return tiles.size() > 0;
}

ClosureCorrection correct_closure(ExchangeTiles& tiles, const Eigen::VectorXd& row_sums,
                                  const Eigen::VectorXd& areas) {
  const Eigen::VectorXd variance = row_variance(tiles);
  ClosureCorrection result;
  Eigen::VectorXd mask = Eigen::VectorXd::Ones(tiles.size());
  for (Index i = 0; i < tiles.size(); ++i) {
    if (is_explained(areas[i] - row_sums[i], variance[i], areas[i])) continue;
    ++result.n_open_rows;
    mask[i] = 0;
  }
  tiles.freeze(mask);
  Eigen::VectorXd sums = row_sums;
  const auto deficits = [&] { return Eigen::VectorXd(mask.cwiseProduct(areas - sums)); };
  const auto is_rounded = [&](Index i) {
    return std::abs(areas[i] - sums[i]) <= kRoundings * tiles.rounding() * areas[i];
  };
  const auto are_closed = [&] {
    for (Index i = 0; i < tiles.size(); ++i) {
      if (mask[i] != 0 && !is_rounded(i)) return false;
    }
    return true;
  };
  for (int round = 0; round < kMaxRounds && !are_closed(); ++round) {
    tiles.correct(solve_multipliers(tiles, deficits()));
    sums = tiles.product(Eigen::VectorXd::Ones(tiles.size())).col(0);
  }
  tiles.unfreeze();
  for (Index i = 0; i < tiles.size(); ++i) {
    if (is_rounded(i)) sums[i] = areas[i];
  }
  tiles.set_row_sums(sums);
  return result;
}

}  // namespace radiosity
