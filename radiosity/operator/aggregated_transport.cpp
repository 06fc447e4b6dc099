#include "radiosity/operator/aggregated_transport.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace radiosity {

AggregatedTransport::AggregatedTransport(const Transport& finer, NeighborGroups groups)
    : finer_(finer), groups_(std::move(groups)), area_(Eigen::VectorXd::Zero(groups_.n_groups)) {
  for (Index i = 0; i < finer.size(); ++i) area_[groups_.group_of[i]] += finer.area()[i];
}

Eigen::MatrixXd AggregatedTransport::means(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(), values.cols());
  // Rounding must not carry a mean out of its values' range: of patches that are all white, say.
  Eigen::VectorXd low(size());
  Eigen::VectorXd high(size());
  for (Index c = 0; c < values.cols(); ++c) {
    low.setConstant(std::numeric_limits<double>::infinity());
    high = -low;
    for (Index i = 0; i < values.rows(); ++i) {
      const std::int32_t g = groups_.group_of[i];
      result(g, c) += finer_.area()[i] / area_[g] * values(i, c);
      low[g] = std::min(low[g], values(i, c));
      high[g] = std::max(high[g], values(i, c));
    }
    result.col(c) = result.col(c).cwiseMax(low).cwiseMin(high);
  }
  return result;
}

Eigen::SparseMatrix<double> AggregatedTransport::means(
    const Eigen::SparseMatrix<double>& passing) const {
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index j = 0; j < passing.outerSize(); ++j) {
    for (Entry entry(passing, j); entry; ++entry) {
      const std::int32_t g = groups_.group_of[entry.row()];
      entries.emplace_back(g, groups_.group_of[j],
                           finer_.area()[entry.row()] / area_[g] * entry.value());
    }
  }
  Eigen::SparseMatrix<double> result(size(), size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Eigen::MatrixXd AggregatedTransport::spread(const Eigen::MatrixXd& group_values) const {
  return group_values(groups_.group_of, Eigen::all);
}

Eigen::MatrixXd AggregatedTransport::apply(const Eigen::MatrixXd& radiosity) const {
  return means(finer_.apply(spread(radiosity)));
}

Eigen::VectorXd AggregatedTransport::row(Index i) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  for (Index patch = 0; patch < finer_.size(); ++patch) {
    if (groups_.group_of[patch] != i) continue;
    const Eigen::VectorXd fine = rows_of(finer_).row(patch);
    for (Index j = 0; j < fine.size(); ++j) {
      result[groups_.group_of[j]] += finer_.area()[patch] / area_[i] * fine[j];
    }
  }
  return result;
}

}  // namespace radiosity
