#include "radiosity/stream/tile_store.h"

#include <cstring>
#include <utility>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

WorkStamp stamp_of(std::uint64_t fingerprint) {
  return {{'R', 'A', 'D', 'T', 'I', 'L', 'E', '1'}, fingerprint};
}

/// With the offset of a tile that is wholly 0.
constexpr std::uint64_t kZeroTile = std::uint64_t{1} << 63U;

constexpr const char* kLostEnd = "the work file has been cut off by another program";

}  // namespace

WorkFileState work_file_state(const std::filesystem::path& path, std::uint64_t fingerprint) {
  return work_file_state(path, stamp_of(fingerprint));
}

TileStore::TileStore(const std::filesystem::path& path, std::uint64_t fingerprint, Start start,
                     const std::vector<double>& areas, Progress progress)
    : file_(path), areas_(areas), progress_(std::move(progress)) {
  begin_work(file_, path, stamp_of(fingerprint), start);
}

void TileStore::start(const TileLayout& layout) {
  layout_ = layout;
  totals_.emplace(layout, areas_);
  offsets_.assign(layout.strips.n_tiles(), 0);
  std::uint64_t offset = sizeof(WorkStamp);
  while (offset < file_.size()) {
    progress_.check();
    const std::vector<std::byte> record = read_record(offset);
    if (record.empty() || !is_sound(record, layout.strips)) break;
    const RecordHeader header = record_header(record);
    totals_->add(decode_tile(record, layout.strips.rows(header.row_strip),
                             layout.strips.rows(header.column_strip)));
    note(header, offset);
    offset += record.size();
  }
  if (offset < file_.size()) file_.truncate(offset);
}

bool TileStore::has(Index row_strip, Index column_strip) const {
  return offsets_[Strips::tile(row_strip, column_strip)] != 0;
}

void TileStore::put(ExchangeTile tile) {
  const std::vector<std::byte> record = encode_tile(tile);
  const std::uint64_t offset = file_.append(record);
  totals_->add(tile);
  note(record_header(record), offset);
}

void TileStore::note(const RecordHeader& header, std::uint64_t offset) {
  const bool is_zero = header.n_certain == 0 && header.n_uncertain == 0;
  offsets_[Strips::tile(header.row_strip, header.column_strip)] =
      is_zero ? offset | kZeroTile : offset;
  n_uncertain_ += header.n_uncertain;
}

/// The record at an offset; empty if the file ends before it does.
std::vector<std::byte> TileStore::read_record(std::uint64_t offset) const {
  std::vector<std::byte> record(sizeof(RecordHeader));
  if (!file_.read(offset, record)) return {};
  const std::size_t size = record_header(record).size;
  if (size < record.size() || size > file_.size() - offset) return {};
  record.resize(size);
  if (!file_.read(offset, record)) return {};
  return record;
}

ExchangeTile TileStore::tile(Index row_strip, Index column_strip) const {
  const Index rows = layout_->strips.rows(row_strip);
  const Index columns = layout_->strips.rows(column_strip);
  const std::uint64_t offset = offsets_[Strips::tile(row_strip, column_strip)];
  if ((offset & kZeroTile) != 0) {
    return {row_strip, column_strip, Eigen::MatrixXd::Zero(rows, columns), {}, {}};
  }
  const std::vector<std::byte> record = read_record(offset);
  if (record.empty()) throw OutputError(kLostEnd);
  return decode_tile(record, rows, columns);
}

std::vector<std::byte> TileStore::record(Index row_strip, Index column_strip) const {
  std::vector<std::byte> record =
      read_record(offsets_[Strips::tile(row_strip, column_strip)] & ~kZeroTile);
  if (record.empty()) throw OutputError(kLostEnd);
  return record;
}

TileStore::UncertainPart TileStore::uncertain_part(Index row_strip, Index column_strip) const {
  const std::uint64_t offset = offsets_[Strips::tile(row_strip, column_strip)];
  UncertainPart part;
  if ((offset & kZeroTile) != 0) return part;
  RecordHeader header;
  bool is_read = file_.read(offset, std::as_writable_bytes(std::span(&header, 1)));
  part.entries.resize(header.n_uncertain);
  const auto entries = std::as_writable_bytes(std::span(part.entries));
  is_read = is_read && file_.read(offset + sizeof(header), entries);
  if (!is_read) throw OutputError(kLostEnd);
  part.is_zero = header.n_certain == 0;
  for (const RecordedEntry& entry : part.entries) part.is_zero = part.is_zero && entry.value == 0;
  return part;
}

}  // namespace radiosity
