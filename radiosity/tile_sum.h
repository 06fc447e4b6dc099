#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "radiosity/parallel.h"
#include "radiosity/strips.h"

namespace radiosity {

/// Sums over tiles are made in this many parts, whatever the number of threads, and added in order.
inline constexpr Index kSumParts = 64;
/// Columns that go through the tiles at once, which bounds the parts' memory.
inline constexpr Index kSumColumns = 8;

/// Σ over all tiles of what `add(row_strip, column_strip, block, sum)` adds to `sum`, for all
/// columns of x, n x k; `block` holds up to kSumColumns columns of x and `sum` is as large.
/// Parallel, with the same bits at any number of threads.
template <typename AddTile>
Eigen::MatrixXd sum_over_tiles(const Strips& strips, const Eigen::MatrixXd& x, const AddTile& add) {
  const Index n_tiles = strips.n_tiles();
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Index first = 0; first < x.cols(); first += kSumColumns) {
    const Index n_columns = std::min(kSumColumns, x.cols() - first);
    const Eigen::MatrixXd block = x.middleCols(first, n_columns);
    std::vector<Eigen::MatrixXd> parts(std::min(kSumParts, std::max<Index>(n_tiles, 1)));
    const auto n_parts = static_cast<Index>(parts.size());
    parallel_for(n_parts, [&](Index part) {
      parts[part] = Eigen::MatrixXd::Zero(x.rows(), n_columns);
      Index column_strip = 0;
      const Index begin = n_tiles * part / n_parts;
      const Index end = n_tiles * (part + 1) / n_parts;
      while (Strips::tile(0, column_strip + 1) <= begin) ++column_strip;
      Index row_strip = begin - Strips::tile(0, column_strip);
      for (Index t = begin; t < end; ++t) {
        add(row_strip, column_strip, block, parts[part]);
        if (++row_strip > column_strip) {
          row_strip = 0;
          ++column_strip;
        }
      }
    });
    parallel_for(
        x.rows(),
        [&](Index i) {
          for (Index c = 0; c < n_columns; ++c) {
            double sum = 0;
            for (const Eigen::MatrixXd& part : parts) sum += part(i, c);
            result(i, first + c) = sum;
          }
        },
        256);
  }
  return result;
}

}  // namespace radiosity
