#pragma once

#include <utility>

#include "radiosity/assembly/strips.h"
#include "radiosity/base/geometry.h"

namespace radiosity {

/// Sums over tiles are made in up to this many parts, whatever the number of threads and ranks, and
/// added in order: one part for so many rows that adding costs little.
inline constexpr Index kSumParts = 64;
inline constexpr Index kRowsOfPart = 256;

/// These parts, each of tiles with consecutive numbers.
struct SumParts {
  explicit SumParts(const Strips& strips);
  Index n_tiles;
  Index n_parts;
  /// The first tile of a part.
  [[nodiscard]] Index begin(Index part) const { return n_tiles * part / n_parts; }
  /// The part that has a tile.
  [[nodiscard]] Index of_tile(Index tile) const { return ((tile + 1) * n_parts - 1) / n_tiles; }
  /// From the first part that a rank has to before the last: none, perhaps, if there are few.
  [[nodiscard]] std::pair<Index, Index> share(int rank, int n_ranks) const;
};

/// How the tiles of a matrix are divided among ranks: each is made by one, which casts the rays,
/// and kept by one, which multiplies with it. Both depend on the strips and the ranks' number
/// alone.
class TileShares {
 public:
  TileShares(const Strips& strips, int n_ranks);

  /// Strips are dealt out in turn, some at a time, so that all have their share of what takes long;
  /// a strip has its tile with itself and those with the half of the others that follow it
  /// (TilePart).
  [[nodiscard]] int maker(Index row_strip, Index column_strip) const;
  /// The rank that has the tile's part of sums, of which each rank has as many one after the other.
  [[nodiscard]] int keeper(Index row_strip, Index column_strip) const;

 private:
  Index n_strips_;
  SumParts parts_;
  int n_ranks_;
};

}  // namespace radiosity
