#include "radiosity/compressed/block_store.h"

#include <cstring>
#include <span>
#include <type_traits>

#include "radiosity/base/error.h"
#include "radiosity/base/fingerprint.h"

namespace radiosity {
namespace {

WorkStamp stamp_of(std::uint64_t fingerprint) {
  return {{'R', 'A', 'D', 'B', 'L', 'C', 'K', '1'}, fingerprint};
}

/// Starts the record of a part. The lists of its MadeBlocks follow.
struct PartHeader {
  std::uint64_t checksum = 0;  // of everything that follows
  std::uint64_t size = 0;      // of the whole record, bytes
  std::uint64_t round = 0;
  std::uint64_t part = 0;
  std::uint64_t n_far = 0, n_coefficients = 0, n_near = 0, n_densities = 0;
  BlockCensus census;
  Census pairs;
};
static_assert(std::is_trivially_copyable_v<PartHeader>);

std::size_t record_size(const PartHeader& header) {
  return sizeof(PartHeader) + header.n_far * sizeof(CompressedBlocks::Far) +
         header.n_near * sizeof(CompressedBlocks::Near) +
         (header.n_coefficients + header.n_densities) * sizeof(float);
}

std::uint64_t checksum(std::span<const std::byte> record) {
  Fingerprint sum;
  sum.add(record.subspan(sizeof(PartHeader::checksum)));
  return sum.value();
}

PartHeader header_of(std::span<const std::byte> record) {
  PartHeader header;
  std::memcpy(&header, record.data(), sizeof(header));
  return header;
}

template <typename T>
void append(std::vector<std::byte>& record, const std::vector<T>& list) {
  const auto bytes = std::as_bytes(std::span(list));
  record.insert(record.end(), bytes.begin(), bytes.end());
}

template <typename T>
void take(const std::byte*& place, std::size_t n, std::vector<T>& list) {
  list.resize(n);
  if (n > 0) std::memcpy(list.data(), place, n * sizeof(T));
  place += n * sizeof(T);
}

}  // namespace

WorkFileState block_file_state(const std::filesystem::path& path, std::uint64_t fingerprint) {
  return work_file_state(path, stamp_of(fingerprint));
}

BlockStore::BlockStore(const std::filesystem::path& path, std::uint64_t fingerprint,
                       WorkStart start, const Progress& progress)
    : file_(path) {
  begin_work(file_, path, stamp_of(fingerprint), start);
  find_records(progress);
}

void BlockStore::find_records(const Progress& progress) {
  std::uint64_t offset = sizeof(WorkStamp);
  while (offset < file_.size()) {
    progress.check();
    const std::vector<std::byte> record = read_record(offset);
    if (record.empty() || header_of(record).checksum != checksum(record)) break;
    known_.push_back({header_of(record).round, header_of(record).part, offset});
    offset += record.size();
  }
  if (offset < file_.size()) file_.truncate(offset);
}

void BlockStore::start_round(std::size_t n_parts, double limit) {
  // Tells it from all other rounds, of which each has its limit, and from those before a change.
  Fingerprint round;
  round.add(round_);
  round.add(n_parts);
  round.add(limit);
  round_ = round.value();
  offsets_.assign(n_parts, 0);
  for (const Known& known : known_) {
    if (known.round == round_ && known.part < n_parts) offsets_[known.part] = known.offset;
  }
}

std::optional<MadeBlocks> BlockStore::part(std::size_t number) const {
  if (offsets_[number] == 0) return std::nullopt;
  return decode_part(record(number)).blocks;
}

std::vector<std::byte> BlockStore::record(std::size_t number) const {
  std::vector<std::byte> record = read_record(offsets_[number]);
  if (record.empty()) throw OutputError("the work file has been cut off by another program");
  return record;
}

void BlockStore::put(std::size_t number, const MadeBlocks& blocks) {
  offsets_[number] = file_.append(encode_part(round_, number, blocks));
}

std::vector<std::byte> encode_part(std::uint64_t round, std::uint64_t number,
                                   const MadeBlocks& blocks) {
  PartHeader header{.round = round,
                    .part = number,
                    .n_far = blocks.far.size(),
                    .n_coefficients = blocks.coefficients.size(),
                    .n_near = blocks.near.size(),
                    .n_densities = blocks.densities.size(),
                    .census = blocks.census,
                    .pairs = blocks.pairs};
  header.size = record_size(header);
  std::vector<std::byte> record;
  record.reserve(header.size);
  append(record, std::vector{header});
  append(record, blocks.far);
  append(record, blocks.coefficients);
  append(record, blocks.near);
  append(record, blocks.densities);
  header.checksum = checksum(record);
  std::memcpy(record.data(), &header.checksum, sizeof(header.checksum));
  return record;
}

DecodedPart decode_part(std::span<const std::byte> record) {
  const PartHeader header = header_of(record);
  DecodedPart part{.number = header.part, .size = header.size, .blocks = {}};
  MadeBlocks& blocks = part.blocks;
  const std::byte* place = record.data() + sizeof(header);
  take(place, header.n_far, blocks.far);
  take(place, header.n_coefficients, blocks.coefficients);
  take(place, header.n_near, blocks.near);
  take(place, header.n_densities, blocks.densities);
  blocks.census = header.census;
  blocks.pairs = header.pairs;
  return part;
}

/// The record at an offset; empty if the file ends before it does, or it is none.
std::vector<std::byte> BlockStore::read_record(std::uint64_t offset) const {
  std::vector<std::byte> record(sizeof(PartHeader));
  if (!file_.read(offset, record)) return {};
  const PartHeader header = header_of(record);
  if (header.size < record.size() || header.size > file_.size() - offset) return {};
  // Numbers of lists that belong together, so that what is read stays within the record.
  const std::uint64_t most = header.size;
  if (header.n_far > most || header.n_near > most || header.n_coefficients > most ||
      header.n_densities > most || record_size(header) != header.size) {
    return {};
  }
  record.resize(header.size);
  if (!file_.read(offset, record)) return {};
  return record;
}

}  // namespace radiosity
