#include "radiosity/assembly/tile_record.h"

#include <bit>
#include <cstring>

#include "radiosity/base/fingerprint.h"

namespace radiosity {
namespace {

constexpr std::size_t kWordBits = 64;

std::size_t n_mask_words(Index n_entries) {
  return (static_cast<std::size_t>(n_entries) + kWordBits - 1) / kWordBits;
}

std::size_t record_size(const RecordHeader& header, Index n_entries) {
  const std::size_t n_words = header.n_certain > 0 ? n_mask_words(n_entries) : 0;
  return sizeof(RecordHeader) + header.n_uncertain * sizeof(RecordedEntry) +
         n_words * sizeof(std::uint64_t) + header.n_certain * sizeof(double);
}

std::uint64_t checksum(std::span<const std::byte> record) {
  Fingerprint sum;
  sum.add(record.subspan(sizeof(RecordHeader::checksum)));
  return sum.value();
}

/// The certain entries of a tile that are not 0: which ones, and their values.
struct CertainEntries {
  std::vector<std::uint64_t> mask;
  std::vector<double> values;
};

CertainEntries certain_entries(const ExchangeTile& tile) {
  Eigen::MatrixXd certain = tile.values;
  for (const UncertainEntry& entry : tile.uncertain) certain(entry.row, entry.column) = 0;
  CertainEntries result{std::vector<std::uint64_t>(n_mask_words(certain.size())), {}};
  for (Index k = 0; k < certain.size(); ++k) {
    const double value = certain.data()[k];
    if (value == 0) continue;
    result.mask[k / kWordBits] |= std::uint64_t{1} << (k % kWordBits);
    result.values.push_back(value);
  }
  return result;
}

template <typename T>
void append(std::vector<std::byte>& bytes, const std::vector<T>& list) {
  const auto more = std::as_bytes(std::span(list));
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

std::vector<std::byte> encode_tile(const ExchangeTile& tile) {
  const CertainEntries certain = certain_entries(tile);
  std::vector<RecordedEntry> uncertain;
  uncertain.reserve(tile.uncertain.size());
  for (const UncertainEntry& entry : tile.uncertain) {
    uncertain.push_back(
        {entry.row, entry.column, entry.error, tile.values(entry.row, entry.column)});
  }
  const auto count = [](auto n) { return static_cast<std::uint32_t>(n); };
  RecordHeader header{.row_strip = count(tile.row_strip),
                      .column_strip = count(tile.column_strip),
                      .n_uncertain = count(uncertain.size()),
                      .n_certain = count(certain.values.size()),
                      .facing = count(tile.census.facing),
                      .visible = count(tile.census.visible),
                      .hidden = count(tile.census.hidden),
                      .undecided = count(tile.census.undecided),
                      .partial = count(tile.census.partial),
                      .rays = static_cast<std::uint64_t>(tile.census.rays)};
  header.size = count(record_size(header, tile.values.size()));

  std::vector<std::byte> record;
  record.reserve(header.size);
  append(record, std::vector{header});
  append(record, uncertain);
  if (header.n_certain > 0) {
    append(record, certain.mask);
    append(record, certain.values);
  }
  header.checksum = checksum(record);
  std::memcpy(record.data(), &header.checksum, sizeof(header.checksum));
  return record;
}

RecordHeader record_header(std::span<const std::byte> record) {
  RecordHeader header;
  std::memcpy(&header, record.data(), sizeof(header));
  return header;
}

bool is_sound(std::span<const std::byte> record, const Strips& strips) {
  const RecordHeader header = record_header(record);
  if (header.row_strip > header.column_strip) return false;
  if (static_cast<Index>(header.column_strip) >= strips.size()) return false;
  const Index n_entries = strips.rows(header.row_strip) * strips.rows(header.column_strip);
  return header.size == record.size() && record_size(header, n_entries) == record.size() &&
         checksum(record) == header.checksum;
}

ExchangeTile decode_tile(std::span<const std::byte> record, Index rows, Index columns) {
  const RecordHeader header = record_header(record);
  ExchangeTile tile{
      header.row_strip, header.column_strip, Eigen::MatrixXd::Zero(rows, columns), {}, {}};
  tile.census = {.facing = header.facing,
                 .visible = header.visible,
                 .hidden = header.hidden,
                 .undecided = header.undecided,
                 .partial = header.partial,
                 .rays = static_cast<std::int64_t>(header.rays)};
  const std::byte* place = record.data() + sizeof(RecordHeader);
  tile.uncertain.reserve(header.n_uncertain);
  for (std::uint32_t k = 0; k < header.n_uncertain; ++k, place += sizeof(RecordedEntry)) {
    RecordedEntry entry;
    std::memcpy(&entry, place, sizeof(entry));
    tile.uncertain.push_back({entry.row, entry.column, entry.error});
    tile.values(entry.row, entry.column) = entry.value;
  }
  if (header.n_certain == 0) return tile;
  const std::byte* value = place + n_mask_words(tile.values.size()) * sizeof(std::uint64_t);
  for (Index first = 0; first < tile.values.size(); first += kWordBits) {
    std::uint64_t word = 0;
    std::memcpy(&word, place, sizeof(word));
    place += sizeof(word);
    for (; word != 0; word &= word - 1, value += sizeof(double)) {
      std::memcpy(tile.values.data() + first + std::countr_zero(word), value, sizeof(double));
    }
  }
  return tile;
}

}  // namespace radiosity
