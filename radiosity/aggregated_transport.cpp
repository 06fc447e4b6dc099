#include "radiosity/aggregated_transport.h"

#include <utility>

namespace radiosity {

AggregatedTransport::AggregatedTransport(const Transport& finer, PatchGroups groups)
    : finer_(finer), groups_(std::move(groups)), area_(Eigen::VectorXd::Zero(groups_.n_groups)) {
  for (Index i = 0; i < finer.size(); ++i) area_[groups_.group_of[i]] += finer.area()[i];
}

Eigen::MatrixXd AggregatedTransport::means(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(), values.cols());
  for (Index c = 0; c < values.cols(); ++c) {
    for (Index i = 0; i < values.rows(); ++i) {
      const std::int32_t g = groups_.group_of[i];
      result(g, c) += finer_.area()[i] / area_[g] * values(i, c);
    }
  }
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
    const Eigen::VectorXd fine = finer_.row(patch);
    for (Index j = 0; j < fine.size(); ++j) {
      result[groups_.group_of[j]] += finer_.area()[patch] / area_[i] * fine[j];
    }
  }
  return result;
}

}  // namespace radiosity
