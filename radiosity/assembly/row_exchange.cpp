#include "radiosity/assembly/row_exchange.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "radiosity/assembly/tile_shares.h"
#include "radiosity/base/parallel.h"
#include "radiosity/base/ranks.h"

namespace radiosity {
namespace {

/// Blocks of each rank that are exchanged at a time.
constexpr Index kBlocksAtOnce = 8;

/// Patches from the first to before the second.
using Range = std::pair<Index, Index>;

/// The patches of a rank's share of blocks.
Range patch_share(Index n_patches, Index block, int rank, int n_ranks) {
  const Index n_blocks = (n_patches + block - 1) / block;
  return {share_begin(n_blocks, rank, n_ranks) * block,
          std::min(n_patches, share_begin(n_blocks, rank + 1, n_ranks) * block)};
}

/// Of these the ones of one round.
Range round_of(Range share, Index round, Index size) {
  const Index first = std::min(share.first + round * size, share.second);
  return {first, std::min(first + size, share.second)};
}

/// Calls visit(column, n) for the columns of a row that a rank keeps, strip by strip.
template <typename Visit>
void for_kept(const Strips& strips, Index row, int rank, int n_ranks, const Visit& visit) {
  const SumParts parts(strips);
  const auto [first_part, last_part] = parts.share(rank, n_ranks);
  const Index first = parts.begin(first_part);
  const Index last = parts.begin(last_part);
  const Index strip = strips.of_row(row);
  for (Index other = 0; other < strips.size(); ++other) {
    const Index tile = Strips::tile(std::min(strip, other), std::max(strip, other));
    if (first <= tile && tile < last) visit(strips.begin(other), strips.rows(other));
  }
}

/// What of the patches' rows is kept here, one after the other.
std::vector<std::byte> pack(const ExchangeMatrix& tiles, const PatchOrder& order, Range patches) {
  const Ranks& ranks = *tiles.ranks();
  std::vector<double> values;
  for (Index i = patches.first; i < patches.second; ++i) {
    const Eigen::VectorXd row = tiles.own_row(order.row(i));
    for_kept(tiles.strips(), order.row(i), ranks.rank(), ranks.size(), [&](Index column, Index n) {
      values.insert(values.end(), row.data() + column, row.data() + column + n);
    });
  }
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

void unpack(const std::vector<std::byte>& bytes, const ExchangeMatrix& tiles,
            const PatchOrder& order, int from, Range patches, Eigen::MatrixXd& rows) {
  const std::byte* place = bytes.data();
  for (Index i = patches.first; i < patches.second; ++i) {
    double* row = rows.col(i - patches.first).data();
    for_kept(tiles.strips(), order.row(i), from, tiles.ranks()->size(), [&](Index column, Index n) {
      std::memcpy(row + column, place, n * sizeof(double));
      place += n * sizeof(double);
    });
  }
}

}  // namespace

void visit_row_share(const ExchangeMatrix& tiles, const PatchOrder& order,
                     const Eigen::VectorXd& area, Index block, const Progress& progress,
                     const SharedRows::Visitor& visit) {
  Ranks& ranks = *tiles.ranks();
  const Index n = tiles.size();
  const int n_ranks = ranks.size();
  const Index size = kBlocksAtOnce * block;
  const auto share = [&](int rank) { return patch_share(n, block, rank, n_ranks); };
  Index n_rounds = 0;
  for (int rank = 0; rank < n_ranks; ++rank) {
    n_rounds = std::max(n_rounds, (share(rank).second - share(rank).first + size - 1) / size);
  }
  for (Index round = 0; round < n_rounds; ++round) {
    progress.check();
    const Range own = round_of(share(ranks.rank()), round, size);
    Eigen::MatrixXd rows(n, own.second - own.first);
    parallel_for(rows.cols(),
                 [&](Index k) { rows.col(k) = tiles.own_row(order.row(own.first + k)); });
    // In each turn all ranks are in pairs, or alone.
    for (int turn = 0; turn < n_ranks; ++turn) {
      const int partner = (turn - ranks.rank() + n_ranks) % n_ranks;
      if (partner == ranks.rank()) continue;
      const Range theirs = round_of(share(partner), round, size);
      unpack(exchange_with(ranks, partner, pack(tiles, order, theirs)), tiles, order, partner, own,
             rows);
    }
    parallel_for((rows.cols() + block - 1) / block, [&](Index k) {
      const Index first = k * block;
      Eigen::MatrixXd visited(n, std::min(block, rows.cols() - first));
      for (Index column = 0; column < visited.cols(); ++column) {
        visited.col(column) = order.to_patches(Eigen::VectorXd(rows.col(first + column))) /
                              area[own.first + first + column];
      }
      visit(own.first + first, visited);
    });
  }
}

void complete_rows(Ranks& ranks, Index block, Eigen::MatrixXd& values) {
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const auto [first, last] = patch_share(values.rows(), block, rank, ranks.size());
    if (first >= last) continue;
    Eigen::MatrixXd share = values.middleRows(first, last - first);
    ranks.broadcast(rank, std::as_writable_bytes(
                              std::span(share.data(), static_cast<std::size_t>(share.size()))));
    values.middleRows(first, last - first) = share;
  }
}

}  // namespace radiosity
