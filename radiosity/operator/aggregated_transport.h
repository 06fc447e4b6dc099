#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/neighbor_groups.h"

namespace radiosity {

/// The operator between groups of patches: their exchange areas are the sums of those of their
/// patches, G_IJ = Σ_{i in I} Σ_{j in J} G_ij, which is exact, and of which none is stored. As
/// certain as the finer operator, but claims no errors of its own.
class AggregatedTransport final : public Transport, public FactorRows {
 public:
  /// Refers to `finer`, which must outlive it.
  AggregatedTransport(const Transport& finer, NeighborGroups groups);

  [[nodiscard]] Index size() const override { return groups_.n_groups; }
  [[nodiscard]] const Eigen::VectorXd& area() const override { return area_; }
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const override;
  [[nodiscard]] Eigen::VectorXd row(Index i) const override;
  [[nodiscard]] Eigen::VectorXd row_error(Index) const override {
    return Eigen::VectorXd::Zero(size());
  }
  [[nodiscard]] ExchangeArea pair(Index i, Index j) const override {
    return {area_[i] * row(i)[j]};
  }
  [[nodiscard]] const FactorRows* rows() const override {
    return finer_.rows() != nullptr ? this : nullptr;
  }
  [[nodiscard]] Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const override {
    return Eigen::MatrixXd::Zero(size(), radiosity.cols());
  }
  [[nodiscard]] double error() const override { return 0; }
  [[nodiscard]] std::size_t bytes() const override { return 0; }
  [[nodiscard]] const AssemblyReport& report() const override { return finer_.report(); }

  /// Area-weighted means over the groups of values per patch, n_groups x k.
  [[nodiscard]] Eigen::MatrixXd means(const Eigen::MatrixXd& values) const;
  /// T_IJ = Σ_{i in I} Σ_{j in J} A_i T_ij / A_I of what patches pass on to each other.
  [[nodiscard]] Eigen::SparseMatrix<double> means(const Eigen::SparseMatrix<double>& passing) const;
  /// The value of its group for every patch, n x k.
  [[nodiscard]] Eigen::MatrixXd spread(const Eigen::MatrixXd& group_values) const;

 private:
  const Transport& finer_;
  NeighborGroups groups_;
  Eigen::VectorXd area_;
  std::vector<std::int32_t> first_;    // per group: into patches_
  std::vector<std::int32_t> patches_;  // group after group, each in their order
  std::vector<double> shares_;         // of these in the areas of their groups
};

}  // namespace radiosity
