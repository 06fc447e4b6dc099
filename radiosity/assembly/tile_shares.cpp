#include "radiosity/assembly/tile_shares.h"

#include <algorithm>

#include "radiosity/assembly/tile_part.h"
#include "radiosity/base/ranks.h"

namespace radiosity {
namespace {

/// How often each rank's turn comes when strips are dealt out, at least, if there are so many.
constexpr Index kTurns = 16;

}  // namespace

SumParts::SumParts(const Strips& strips)
    : n_tiles(strips.n_tiles()),
      n_parts(std::clamp<Index>(strips.n_rows() / kRowsOfPart, 1, kSumParts)) {}

std::pair<Index, Index> SumParts::share(int rank, int n_ranks) const {
  return {share_begin(n_parts, rank, n_ranks), share_begin(n_parts, rank + 1, n_ranks)};
}

TileShares::TileShares(const Strips& strips, int n_ranks)
    : n_strips_(strips.size()), parts_(strips), n_ranks_(n_ranks) {}

int TileShares::maker(Index row_strip, Index column_strip) const {
  const Index strip = owning_strip(row_strip, column_strip, n_strips_);
  const Index at_a_time = std::max<Index>(n_strips_ / (kTurns * n_ranks_), 1);
  return static_cast<int>(strip / at_a_time % n_ranks_);
}

int TileShares::keeper(Index row_strip, Index column_strip) const {
  const Index part = parts_.of_tile(Strips::tile(row_strip, column_strip));
  int rank = static_cast<int>(part * n_ranks_ / parts_.n_parts);
  while (part < parts_.share(rank, n_ranks_).first) --rank;
  while (part >= parts_.share(rank, n_ranks_).second) ++rank;
  return rank;
}

}  // namespace radiosity
