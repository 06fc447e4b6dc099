#include "radiosity/compressed/row_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/exchange/visible_fraction.h"

namespace radiosity {
namespace {

/// Of Student's distribution, one-sided, for some tens of samples.
constexpr double kQuantile = 1.67;
/// Errors of entries that rows are checked by, next to those of the operator.
constexpr double kShareOfErrors = 0.2;

}  // namespace

RowCheck::RowCheck(const ExchangeEvaluator& evaluator, const ClusterShapes& shapes,
                   const std::vector<double>& areas, Eigen::MatrixXd radiosity, std::uint64_t seed)
    : evaluator_(evaluator),
      shapes_(shapes),
      areas_(areas),
      radiosity_(std::move(radiosity)),
      seed_(seed) {}

void RowCheck::add_rows(Index n, const Progress& progress) {
  const auto& order = evaluator_.tree().order;
  if (order.empty()) return;
  const auto first = static_cast<std::ptrdiff_t>(rows_.size());
  // One of each n-th part of the area, in the tree's order.
  for (Index k = 0; k < n; ++k) {
    const std::uint64_t bits =
        pair_seed(seed_, static_cast<std::int32_t>(first), static_cast<std::int32_t>(k));
    const double share = static_cast<double>(bits >> 11U) * 0x1p-53;
    const std::int32_t place =
        shapes_.place_at(0, (static_cast<double>(k) + share) / static_cast<double>(n));
    rows_.push_back(order[place]);
  }
  gathered_.resize(rows_.size());
  parallel_for(n, [&](std::ptrdiff_t k) {
    progress.check();
    const std::int32_t patch = rows_[first + k];
    ExchangeEvaluator::Worker worker = evaluator_.checking_worker(kShareOfErrors);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(radiosity_.cols());
    evaluator_.visit_row(patch, worker, [&](Index column, const ExchangeArea& entry) {
      sum += entry.value / areas_[patch] * radiosity_.row(order[column]).transpose();
    });
    gathered_[first + k] = sum;
  });
}

RowCheck::Error RowCheck::error(const Eigen::MatrixXd& gathered) const {
  const auto n = static_cast<double>(rows_.size());
  const Eigen::Map<const Eigen::VectorXd> area(areas_.data(), static_cast<Index>(areas_.size()));
  Error result{.n_rows = n_rows()};
  if (rows_.empty()) return result;
  const Eigen::VectorXd of_ones = gathered.col(0);
  for (Index field = 0; field < gathered.cols(); ++field) {
    // Of light that may be negative, what all of it would give: signs cancel, and prove nothing.
    const Eigen::VectorXd all =
        radiosity_.col(field).minCoeff() < 0 ? of_ones : Eigen::VectorXd(gathered.col(field));
    const double size = area.dot(all.cwiseAbs2()) / area.sum();
    if (!(size > 0)) continue;
    Eigen::ArrayXd squares(n_rows());
    for (Index k = 0; k < n_rows(); ++k) {
      squares[k] = square(gathered(rows_[k], field) - gathered_[k][field]) / size;
    }
    const double mean = squares.mean();
    const Eigen::ArrayXd off = squares - mean;
    const double deviation = std::sqrt(off.square().sum() / std::max(n - 1, 1.0));
    const double skewness =
        deviation > 0 ? off.cube().mean() / (deviation * deviation * deviation) : 0;
    // Johnson 1978: the mean of skewed samples.
    const double quantile =
        kQuantile + skewness * (1 + 2 * kQuantile * kQuantile) / (6 * std::sqrt(n));
    result.estimate = std::max(result.estimate, std::sqrt(mean));
    result.limit = std::max(result.limit, std::sqrt(mean + quantile * deviation / std::sqrt(n)));
  }
  return result;
}

}  // namespace radiosity
