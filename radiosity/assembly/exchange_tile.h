#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/assembly/strips.h"
#include "radiosity/base/geometry.h"
#include "radiosity/operator/census.h"

namespace radiosity {

/// The standard error of one uncertain entry of a tile.
struct UncertainEntry {
  std::uint16_t row;  ///< within the tile
  std::uint16_t column;
  float error;  ///< one sigma of G_ij, m²
};

/// The exchange areas between the patches of two strips.
struct ExchangeTile {
  Index row_strip = 0;  ///< <= column_strip
  Index column_strip = 0;
  Eigen::MatrixXd values;  ///< G_ij, m²; symmetric if the strips are the same
  /// Entries that are not exact; on both sides of the diagonal if the strips are the same.
  std::vector<UncertainEntry> uncertain;
  Census census;
};

/// How the patches make up rows and these make up strips.
struct TileLayout {
  std::vector<std::int32_t> order;  ///< patch of each row
  Strips strips;
};

/// Takes the tiles of the exchange matrix as they get finished.
class TileSink {
 public:
  virtual ~TileSink() = default;
  /// Called once, before everything else.
  virtual void start(const TileLayout& layout) = 0;
  /// Whether the tile is wanted at all: those of other parts of the work are made elsewhere.
  [[nodiscard]] virtual bool owns(Index /*row_strip*/, Index /*column_strip*/) const {
    return true;
  }
  /// Whether the tile is there already and need not be made.
  [[nodiscard]] virtual bool has(Index row_strip, Index column_strip) const = 0;
  /// Takes a tile. Called from many threads at once, in any order, once for each tile.
  virtual void put(ExchangeTile tile) = 0;
};

}  // namespace radiosity
