#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "radiosity/assembly/tile_record.h"
#include "radiosity/assembly/tile_totals.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/base/work_file.h"
#include "radiosity/base/work_stamp.h"

namespace radiosity {

/// Of a work file of tiles. Throws OutputError if there is a file that is no work file.
WorkFileState work_file_state(const std::filesystem::path& path, std::uint64_t fingerprint);

/// The tiles of an exchange matrix in a work file: a header with the fingerprint of the
/// computation, then a record for each tile, in the order in which they were finished. Each record
/// has a checksum: whatever stops the program, all whole records count and the rest is cut off. In
/// memory is only where each tile is, 8 bytes for each of at most n²/2048 tiles.
class TileStore final : public TileSink {
 public:
  using Start = WorkStart;

  /// Opens the file; `resumed` keeps the tiles of a file of the same computation. `areas` are those
  /// of the patches, m². Throws OutputError.
  TileStore(const std::filesystem::path& path, std::uint64_t fingerprint, Start start,
            const std::vector<double>& areas, Progress progress = {});

  /// Finds the tiles that the file has.
  void start(const TileLayout& layout) override;
  [[nodiscard]] bool has(Index row_strip, Index column_strip) const override;
  void put(ExchangeTile tile) override;

  [[nodiscard]] const TileLayout& layout() const { return *layout_; }
  [[nodiscard]] const TileTotals& totals() const { return *totals_; }
  /// Number of uncertain entries in all tiles.
  [[nodiscard]] std::int64_t n_uncertain() const { return n_uncertain_; }
  /// Size of the file.
  [[nodiscard]] std::uint64_t bytes() const { return file_.size(); }

  /// Reads a tile, once all were put. Callable from many threads.
  [[nodiscard]] ExchangeTile tile(Index row_strip, Index column_strip) const;

  struct UncertainPart {
    std::vector<RecordedEntry> entries;
    bool is_zero = true;  ///< whether all values of the tile are 0
  };
  /// Reads only the uncertain entries of a tile; likewise.
  [[nodiscard]] UncertainPart uncertain_part(Index row_strip, Index column_strip) const;

  /// The bytes that the file has of a tile that was put.
  [[nodiscard]] std::vector<std::byte> record(Index row_strip, Index column_strip) const;

  /// Removes the file.
  void remove() const { file_.remove(); }

 private:
  [[nodiscard]] std::vector<std::byte> read_record(std::uint64_t offset) const;
  void note(const RecordHeader& header, std::uint64_t offset);

  WorkFile file_;
  std::vector<double> areas_;
  Progress progress_;
  std::optional<TileLayout> layout_;
  std::optional<TileTotals> totals_;
  std::vector<std::uint64_t> offsets_;  // per tile, and kZeroTile; 0 = not there yet
  std::atomic<std::int64_t> n_uncertain_ = 0;
};

}  // namespace radiosity
