#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "radiosity/assembly/part_chain.h"
#include "radiosity/assembly/strips.h"
#include "radiosity/assembly/tile_shares.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/parallel.h"

namespace radiosity {

/// Columns that go through the tiles at once, which bounds the parts' memory.
inline constexpr Index kSumColumns = 8;

/// Σ over all tiles of what `add(row_strip, column_strip, block, sum)` adds to `sum`, for all
/// columns of x, n x k; `block` holds up to kSumColumns columns of x, as many as a Block has if it
/// has a fixed number (unused ones are 0), and `sum` is as large. Parallel, with the same bits at
/// any number of threads; where there are `ranks`, each adds its share of the parts (SumParts) and
/// all get the sum, with the same bits as one alone.
template <typename Block = Eigen::MatrixXd, typename AddTile>
Eigen::MatrixXd sum_over_tiles(const Strips& strips, const Eigen::MatrixXd& x, const AddTile& add,
                               Ranks* ranks = nullptr) {
  const SumParts all(strips);
  const std::pair<Index, Index> own =
      ranks != nullptr ? all.share(ranks->rank(), ranks->size()) : std::pair(Index{0}, all.n_parts);
  const Index first_part = own.first;
  const Index n_parts = own.second - first_part;
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Index first = 0; first < x.cols(); first += kSumColumns) {
    const Index n_columns = std::min(kSumColumns, x.cols() - first);
    const bool is_fixed = Block::ColsAtCompileTime != Eigen::Dynamic;
    const Index width = is_fixed ? Index{Block::ColsAtCompileTime} : n_columns;
    Block block = Block::Zero(x.rows(), width);
    block.leftCols(n_columns) = x.middleCols(first, n_columns);
    std::vector<Block> parts(n_parts);
    parallel_for(n_parts, [&](Index part) {
      parts[part] = Block::Zero(x.rows(), width);
      Index column_strip = 0;
      const Index begin = all.begin(first_part + part);
      const Index end = all.begin(first_part + part + 1);
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
    if (ranks != nullptr) {
      std::vector<const double*> values;
      for (const Block& part : parts) values.push_back(part.data());
      Block sum(x.rows(), width);
      add_along_ranks(*ranks, all, values, {sum.data(), static_cast<std::size_t>(sum.size())});
      result.middleCols(first, n_columns) = sum.leftCols(n_columns);
      continue;
    }
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
