#include "radiosity/compressed/shared_parts.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <span>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// How often all ranks tell each other what they have made, which the first then keeps on disk.
constexpr std::size_t kBatches = 8;

/// The bytes of each rank, on all ranks.
std::vector<std::vector<std::byte>> gather_from_all(Ranks& ranks,
                                                    const std::vector<std::byte>& own) {
  std::vector<std::vector<std::byte>> all(ranks.size());
  for (int rank = 0; rank < ranks.size(); ++rank) {
    std::uint64_t size = own.size();
    ranks.broadcast(rank, std::as_writable_bytes(std::span(&size, 1)));
    all[rank] = rank == ranks.rank() ? own : std::vector<std::byte>(size);
    ranks.broadcast(rank, all[rank]);
  }
  return all;
}

void add_bytes(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

/// Takes all records that follow each other.
void take_records(std::span<const std::byte> records, std::vector<MadeBlocks>& made) {
  while (!records.empty()) {
    DecodedPart part = decode_part(records);
    records = records.subspan(part.size);
    made[part.number] = std::move(part.blocks);
  }
}

}  // namespace

std::vector<MadeBlocks> make_shared_parts(Ranks& ranks, std::size_t n_parts, BlockStore* store,
                                          const std::function<MadeBlocks(std::size_t)>& make,
                                          const Progress& progress) {
  std::vector<MadeBlocks> made(n_parts);
  std::vector<std::uint8_t> is_there(n_parts, 0);
  std::vector<std::byte> known;
  if (store != nullptr) {
    for (std::size_t k = 0; k < n_parts; ++k) {
      if (!store->has(k)) continue;
      is_there[k] = 1;
      add_bytes(known, store->record(k));
    }
  }
  ranks.broadcast(0, std::as_writable_bytes(std::span(is_there)));
  take_records(gather_from_all(ranks, known)[0], made);
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < n_parts; ++k) {
    if (is_there[k] == 0) missing.push_back(k);
  }

  std::mutex mutex;
  const auto n_ranks = static_cast<std::size_t>(ranks.size());
  auto n_done = static_cast<double>(n_parts - missing.size());
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    progress.check();
    const std::size_t begin = missing.size() * batch / kBatches;
    const std::size_t end = missing.size() * (batch + 1) / kBatches;
    std::vector<std::size_t> own;
    for (std::size_t m = begin + ranks.rank(); m < end; m += n_ranks) own.push_back(missing[m]);
    const double before = n_done;
    std::vector<std::byte> records;
    parallel_for(static_cast<std::ptrdiff_t>(own.size()), [&](std::ptrdiff_t k) {
      const MadeBlocks blocks = make(own[k]);
      if (store != nullptr) store->put(own[k], blocks);
      const std::vector<std::byte> record = encode_part(0, own[k], blocks);
      const std::lock_guard lock(mutex);
      add_bytes(records, record);
      n_done += static_cast<double>(n_ranks);
      if (!progress.report) return;
      // Of the others it is not known yet how far they are: as far as this one, that is.
      const double most = before + static_cast<double>(end - begin);
      progress.report("form factors", std::min(n_done, most), static_cast<double>(n_parts),
                      "parts");
    });
    const std::vector<std::vector<std::byte>> all = gather_from_all(ranks, records);
    for (const std::vector<std::byte>& of_rank : all) take_records(of_rank, made);
    if (store != nullptr) {
      for (std::size_t m = begin; m < end; ++m) {
        if (!store->has(missing[m])) store->put(missing[m], made[missing[m]]);
      }
    }
    n_done = before + static_cast<double>(end - begin);
  }
  return made;
}

}  // namespace radiosity
