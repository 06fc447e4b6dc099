#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/parallel.h"

namespace radiosity {

/// In which order a matrix has the patches.
class PatchOrder {
 public:
  /// `patches` is a permutation: the patch of each row.
  explicit PatchOrder(std::vector<std::int32_t> patches)
      : patches_(std::move(patches)), rows_(patches_.size()) {
    for (std::size_t row = 0; row < patches_.size(); ++row) {
      rows_[patches_[row]] = static_cast<std::int32_t>(row);
    }
  }

  [[nodiscard]] std::int32_t row(Index patch) const { return rows_[patch]; }

  /// Values of patches, n x k, in the order of the rows.
  [[nodiscard]] Eigen::MatrixXd to_rows(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd result(x.rows(), x.cols());
    for_rows(x, [&](Index row, Index c) { result(row, c) = x(patches_[row], c); });
    return result;
  }
  /// The same of weight[patch] times the values.
  [[nodiscard]] Eigen::MatrixXd to_rows(const Eigen::MatrixXd& x,
                                        const Eigen::VectorXd& weight) const {
    Eigen::MatrixXd result(x.rows(), x.cols());
    for_rows(x, [&](Index row, Index c) {
      result(row, c) = weight[patches_[row]] * x(patches_[row], c);
    });
    return result;
  }
  /// Values of rows, n x k, in the order of the patches.
  [[nodiscard]] Eigen::MatrixXd to_patches(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd result(x.rows(), x.cols());
    for_rows(x, [&](Index row, Index c) { result(patches_[row], c) = x(row, c); });
    return result;
  }

  /// Values that are kept row after row.
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// weight[patch] times the values in `n_columns` columns from `first` on, in the order of the
  /// rows, n x width; zeros in columns beyond.
  [[nodiscard]] RowMajor to_rows(const Eigen::MatrixXd& x, const Eigen::VectorXd& weight,
                                 Index first, Index n_columns, Index width) const {
    RowMajor result(x.rows(), width);
    parallel_ranges(x.rows(), kGrain, [&](Index begin, Index end) {
      double* value = result.data() + begin * width;
      for (Index row = begin; row < end; ++row) {
        const std::int32_t patch = patches_[row];
        const double factor = weight[patch];
        for (Index c = 0; c < n_columns; ++c) *value++ = factor * x(patch, first + c);
        for (Index c = n_columns; c < width; ++c) *value++ = 0;
      }
    });
    return result;
  }
  /// Puts the first `n_columns` columns of values of rows, in the order of the patches, into those
  /// of `result` from `first` on.
  void to_patches(const RowMajor& x, Index first, Index n_columns, Eigen::MatrixXd& result) const {
    const Index width = x.cols();
    parallel_ranges(x.rows(), kGrain, [&](Index begin, Index end) {
      for (Index patch = begin; patch < end; ++patch) {
        const double* value = x.data() + rows_[patch] * width;
        for (Index c = 0; c < n_columns; ++c) result(patch, first + c) = value[c];
      }
    });
  }

  [[nodiscard]] std::size_t bytes() const {
    return (patches_.size() + rows_.size()) * sizeof(std::int32_t);
  }

 private:
  static constexpr Index kGrain = 16384;

  template <typename Copy>
  static void for_rows(const Eigen::MatrixXd& x, const Copy& copy) {
    parallel_ranges(x.rows(), kGrain, [&](Index begin, Index end) {
      for (Index c = 0; c < x.cols(); ++c) {
        for (Index row = begin; row < end; ++row) copy(row, c);
      }
    });
  }

  std::vector<std::int32_t> patches_;  // per row
  std::vector<std::int32_t> rows_;     // per patch
};

}  // namespace radiosity
