#include "radiosity/compressed/row_check.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/exchange/visible_fraction.h"

namespace radiosity {
namespace {

/// Of Student's distribution, one-sided, for some tens of samples.
constexpr double kQuantile = 1.67;
/// Errors of entries that rows are checked by, next to those of the operator.
constexpr double kShareOfErrors = 0.2;
/// Rows that verify an operator, and as many again as long as they do not decide.
constexpr Index kRows = 96;
constexpr Index kMostRows = 384;
/// They may still decide that it will do if their error is that much smaller than what is asked.
constexpr double kMayDo = 0.85;
/// Rows that are spread over the area; the others follow the errors.
constexpr double kShareOfArea = 1.0 / 3;

}  // namespace

RowCheck::RowCheck(const ExchangeEvaluator& evaluator, const std::vector<double>& areas,
                   const Eigen::VectorXd& told, Eigen::MatrixXd radiosity, std::uint64_t seed,
                   Ranks* ranks)
    : evaluator_(evaluator),
      areas_(areas),
      radiosity_(std::move(radiosity)),
      seed_(seed),
      ranks_(ranks) {
  const Eigen::Map<const Eigen::VectorXd> area(areas_.data(), static_cast<Index>(areas_.size()));
  const double all_area = area.sum();
  const double in_all = area.dot(told.cwiseAbs2());
  double sum = 0;
  for (const std::int32_t patch : evaluator.tree().order) {
    const double of_area = area[patch] / all_area;
    const double of_errors = in_all > 0 ? area[patch] * square(told[patch]) / in_all : of_area;
    sum += kShareOfArea * of_area + (1 - kShareOfArea) * of_errors;
    shares_.push_back(sum);
  }
}

void RowCheck::add_rows(Index n, const Progress& progress) {
  const auto& order = evaluator_.tree().order;
  if (order.empty()) return;
  const auto first = static_cast<std::ptrdiff_t>(rows_.size());
  const double area =
      Eigen::Map<const Eigen::VectorXd>(areas_.data(), static_cast<Index>(areas_.size())).sum();
  // One of each n-th part of the shares, in the tree's order.
  for (Index k = 0; k < n; ++k) {
    const std::uint64_t bits =
        pair_seed(seed_, static_cast<std::int32_t>(first), static_cast<std::int32_t>(k));
    const double share = static_cast<double>(bits >> 11U) * 0x1p-53;
    const double at = (static_cast<double>(k) + share) / static_cast<double>(n) * shares_.back();
    const auto found = std::upper_bound(shares_.begin(), shares_.end() - 1, at) - shares_.begin();
    const double own = shares_[found] - (found > 0 ? shares_[found - 1] : 0);
    rows_.push_back(order[found]);
    weights_.push_back(areas_[order[found]] / area / own);
  }
  gathered_.resize(rows_.size());
  parallel_for(n, [&](std::ptrdiff_t k) {
    progress.check();
    gathered_[first + k] = Eigen::VectorXd::Zero(radiosity_.cols());
    if (ranks_ != nullptr && k % ranks_->size() != ranks_->rank()) return;
    const std::int32_t patch = rows_[first + k];
    ExchangeEvaluator::Worker worker = evaluator_.checking_worker(kShareOfErrors);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(radiosity_.cols());
    evaluator_.visit_row(patch, worker, [&](Index column, const ExchangeArea& entry) {
      sum += entry.value / areas_[patch] * radiosity_.row(order[column]).transpose();
    });
    gathered_[first + k] = sum;
  });
  if (ranks_ == nullptr) return;
  Eigen::MatrixXd all(radiosity_.cols(), n);
  for (Index k = 0; k < n; ++k) all.col(k) = gathered_[first + k];
  sum_over_ranks(*ranks_, std::span(all.data(), static_cast<std::size_t>(all.size())));
  for (Index k = 0; k < n; ++k) gathered_[first + k] = all.col(k);
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
      squares[k] = weights_[k] * square(gathered(rows_[k], field) - gathered_[k][field]) / size;
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

RowCheck::Error RowCheck::decide(const Eigen::MatrixXd& gathered, double tolerance,
                                 const Progress& progress) {
  if (rows_.empty()) add_rows(kRows, progress);
  Error result = error(gathered);
  while (result.limit > tolerance && result.estimate < kMayDo * tolerance && n_rows() < kMostRows) {
    add_rows(n_rows(), progress);
    result = error(gathered);
  }
  return result;
}

Eigen::VectorXd likely_errors(const CompressedTransport& transport) {
  const PatchOrder& order = transport.order();
  return order.to_patches(transport.matrix().common_errors(order.to_rows(transport.area())));
}

}  // namespace radiosity
