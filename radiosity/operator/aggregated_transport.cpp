#include "radiosity/operator/aggregated_transport.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "radiosity/base/parallel.h"

namespace radiosity {

AggregatedTransport::AggregatedTransport(const Transport& finer, NeighborGroups groups)
    : finer_(finer), groups_(std::move(groups)), area_(Eigen::VectorXd::Zero(groups_.n_groups)) {
  for (Index i = 0; i < finer.size(); ++i) area_[groups_.group_of[i]] += finer.area()[i];
  first_.assign(groups_.n_groups + 1, 0);
  for (const std::int32_t group : groups_.group_of) ++first_[group + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  patches_.resize(groups_.group_of.size());
  shares_.resize(patches_.size());
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const std::int32_t group = groups_.group_of[i];
    shares_[next[group]] = finer.area()[static_cast<Index>(i)] / area_[group];
    patches_[next[group]++] = static_cast<std::int32_t>(i);
  }
}

Eigen::MatrixXd AggregatedTransport::means(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result(size(), values.cols());
  const auto mean = [&](Index g, Index c) {
    double sum = 0;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::int32_t k = first_[g]; k < first_[g + 1]; ++k) {
      const double value = values(patches_[k], c);
      sum += shares_[k] * value;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    // Rounding must not carry a mean out of its values' range: of patches that are all white, say.
    return std::min(std::max(sum, low), high);
  };
  parallel_segments(size(), [&](Index begin, Index n) {
    for (Index c = 0; c < values.cols(); ++c) {
      for (Index g = begin; g < begin + n; ++g) result(g, c) = mean(g, c);
    }
  });
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
  const auto n_patches = static_cast<Index>(groups_.group_of.size());
  Eigen::MatrixXd result(n_patches, group_values.cols());
  parallel_segments(n_patches, [&](Index begin, Index n) {
    for (Index c = 0; c < group_values.cols(); ++c) {
      for (Index i = begin; i < begin + n; ++i) result(i, c) = group_values(groups_.group_of[i], c);
    }
  });
  return result;
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
