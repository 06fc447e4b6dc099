#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "radiosity/assembly/strips.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/parallel.h"

namespace radiosity {

/// Sums over tiles are made in up to this many parts, whatever the number of threads, and added in
/// order: one part for so many rows that adding costs little.
inline constexpr Index kSumParts = 64;
inline constexpr Index kRowsOfPart = 256;
/// Columns that go through the tiles at once, which bounds the parts' memory.
inline constexpr Index kSumColumns = 8;

/// Σ over all tiles of what `add(row_strip, column_strip, block, sum)` adds to `sum`, for all
/// columns of x, n x k; `block` holds up to kSumColumns columns of x, as many as a Block has if it
/// has a fixed number (unused ones are 0), and `sum` is as large. Parallel, with the same bits at
/// any number of threads.
template <typename Block = Eigen::MatrixXd, typename AddTile>
Eigen::MatrixXd sum_over_tiles(const Strips& strips, const Eigen::MatrixXd& x, const AddTile& add) {
  const Index n_tiles = strips.n_tiles();
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Index first = 0; first < x.cols(); first += kSumColumns) {
    const Index n_columns = std::min(kSumColumns, x.cols() - first);
    const bool is_fixed = Block::ColsAtCompileTime != Eigen::Dynamic;
    const Index width = is_fixed ? Index{Block::ColsAtCompileTime} : n_columns;
    Block block = Block::Zero(x.rows(), width);
    block.leftCols(n_columns) = x.middleCols(first, n_columns);
    std::vector<Block> parts(std::clamp<Index>(x.rows() / kRowsOfPart, 1, kSumParts));
    const auto n_parts = static_cast<Index>(parts.size());
    parallel_for(n_parts, [&](Index part) {
      parts[part] = Block::Zero(x.rows(), width);
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
    constexpr Index kGrain = 16;
    parallel_for((x.rows() + kRowsOfPart - 1) / kRowsOfPart,
                 [&](Index k) {
                   const Index begin = k * kRowsOfPart;
                   const Index rows = std::min(kRowsOfPart, x.rows() - begin);
                   Block sum = parts[0].middleRows(begin, rows);
                   for (Index part = 1; part < n_parts; ++part) {
                     sum += parts[part].middleRows(begin, rows);
                   }
                   result.block(begin, first, rows, n_columns) = sum.leftCols(n_columns);
                 },
                 kGrain);
  }
  return result;
}

}  // namespace radiosity
