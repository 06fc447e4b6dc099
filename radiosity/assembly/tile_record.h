#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/base/geometry.h"

namespace radiosity {

/// An uncertain entry as a record holds it.
struct RecordedEntry {
  std::uint16_t row;  ///< within the tile
  std::uint16_t column;
  float error;   ///< one sigma of G_ij, m²
  double value;  ///< G_ij, m²
};

/// Starts the record of a tile. After it come the uncertain entries and then, if there are any, the
/// certain ones: a bit for each entry of the tile, column by column, and the values of those set.
struct RecordHeader {
  std::uint64_t checksum = 0;  ///< of everything that follows
  std::uint32_t size = 0;      ///< of the whole record, bytes; a multiple of 8
  std::uint32_t row_strip = 0;
  std::uint32_t column_strip = 0;
  std::uint32_t n_uncertain = 0;
  std::uint32_t n_certain = 0;  ///< of those that are not 0
  std::uint32_t facing = 0, visible = 0, hidden = 0, undecided = 0, partial = 0;
  std::uint64_t rays = 0;
};

/// The bytes of a tile's record.
std::vector<std::byte> encode_tile(const ExchangeTile& tile);

/// The header at the start of a record.
RecordHeader record_header(std::span<const std::byte> record);

/// Whether header and checksum fit a whole record of a tile of these strips.
bool is_sound(std::span<const std::byte> record, const Strips& strips);

/// The tile of a sound record, `rows` x `columns`.
ExchangeTile decode_tile(std::span<const std::byte> record, Index rows, Index columns);

}  // namespace radiosity
