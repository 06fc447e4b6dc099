#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/base/work_file.h"
#include "radiosity/base/work_stamp.h"
#include "radiosity/compressed/made_blocks.h"

namespace radiosity {

/// Throws OutputError if there is a file that is no work file.
WorkFileState block_file_state(const std::filesystem::path& path, std::uint64_t fingerprint);

/// The record of a part of a round. It has all that the part is.
std::vector<std::byte> encode_part(std::uint64_t round, std::uint64_t number,
                                   const MadeBlocks& blocks);
struct DecodedPart {
  std::uint64_t number = 0;
  std::size_t size = 0;  ///< of its record, bytes
  MadeBlocks blocks;
};
/// The part of a sound record, with which the bytes begin.
DecodedPart decode_part(std::span<const std::byte> record);

/// Parts of a compressed operator in a work file: a stamp with the fingerprint of the computation,
/// then a record for each part, in the order in which they were finished. Each has a checksum:
/// whatever stops the program, all whole records count and the rest is cut off.
class BlockStore {
 public:
  /// Opens the file; `resumed` keeps the parts of a file of the same computation. Throws
  /// OutputError; Interrupted.
  BlockStore(const std::filesystem::path& path, std::uint64_t fingerprint, WorkStart start,
             const Progress& progress = {});

  /// The parts that follow are `n_parts` of the next round, of blocks of at most `limit`.
  void start_round(std::size_t n_parts, double limit);
  /// Whether the file has a part of this round.
  [[nodiscard]] bool has(std::size_t number) const { return offsets_[number] != 0; }
  /// A part of this round, if the file has it. Callable from many threads.
  [[nodiscard]] std::optional<MadeBlocks> part(std::size_t number) const;
  /// Likewise.
  void put(std::size_t number, const MadeBlocks& blocks);
  /// Number of parts of this round.
  [[nodiscard]] std::size_t n_parts() const { return offsets_.size(); }
  /// The bytes that the file has of a part of this round that is there.
  [[nodiscard]] std::vector<std::byte> record(std::size_t number) const;

  /// Removes the file.
  void remove() const { file_.remove(); }

 private:
  struct Known {
    std::uint64_t round;  // a hash of all that tells it
    std::uint64_t part;
    std::uint64_t offset;
  };
  [[nodiscard]] std::vector<std::byte> read_record(std::uint64_t offset) const;
  void find_records(const Progress& progress);

  WorkFile file_;
  std::vector<Known> known_;            // those of the file as it was opened
  std::vector<std::uint64_t> offsets_;  // of this round's parts; 0 = not there
  std::uint64_t round_ = 0;
};

}  // namespace radiosity
