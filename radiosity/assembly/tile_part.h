#pragma once

#include <optional>
#include <utility>

#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/base/work_part.h"

namespace radiosity {

/// Of the two strips of a tile, row strip <= column strip, the one that has it: each strip has its
/// tile with itself and those with the half of the others that follow it, going on with the first
/// after the last.
Index owning_strip(Index row_strip, Index column_strip, Index n_strips);

/// Which tiles a part of the work makes. The strips are divided among the parts in their order, by
/// about equal numbers of rows; a strip has its tile with itself and those with the half of the
/// others that follow it, going on with the first after the last. So each tile is of one part, and
/// all parts have about equally many entries. Depends on strips and part alone.
class TilePart {
 public:
  TilePart(const Strips& strips, WorkPart part);

  /// Whether the tile, row strip <= column strip, is of this part.
  [[nodiscard]] bool owns(Index row_strip, Index column_strip) const;
  /// Its strips, from the first to before the second.
  [[nodiscard]] std::pair<Index, Index> strips() const { return {first_, last_}; }

 private:
  Index n_strips_;
  Index first_;
  Index last_;
};

/// Takes the tiles of one part for another sink.
class TilePartSink final : public TileSink {
 public:
  TilePartSink(TileSink& sink, WorkPart part) : sink_(sink), part_(part) {}

  void start(const TileLayout& layout) override;
  [[nodiscard]] bool owns(Index row_strip, Index column_strip) const override {
    return tiles_->owns(row_strip, column_strip);
  }
  [[nodiscard]] bool has(Index row_strip, Index column_strip) const override {
    return sink_.has(row_strip, column_strip);
  }
  void put(ExchangeTile tile) override { sink_.put(std::move(tile)); }

 private:
  TileSink& sink_;
  WorkPart part_;
  std::optional<TilePart> tiles_;
};

}  // namespace radiosity
