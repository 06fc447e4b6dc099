#include "radiosity/assembly/shared_tiles.h"

#include <chrono>
#include <cstring>
#include <utility>

#include "radiosity/assembly/tile_record.h"

namespace radiosity {
namespace {

using Clock = std::chrono::steady_clock;
/// How long the thread that takes the others' tiles sleeps if there are none.
constexpr auto kNap = std::chrono::milliseconds(1);
/// How often a rank tells how far it is.
constexpr auto kCountInterval = std::chrono::milliseconds(200);

/// Pairs that a rank has made since it told so last. Any other message is the record of a tile.
struct PairCount {
  double pairs = 0;
  std::uint64_t is_last = 0;
};

double pairs_of(const Strips& strips, Index row_strip, Index column_strip) {
  const auto rows = static_cast<double>(strips.rows(row_strip));
  return row_strip == column_strip ? 0.5 * rows * (rows - 1)
                                   : rows * static_cast<double>(strips.rows(column_strip));
}

}  // namespace

SharedTileSink::SharedTileSink(TileSink& own, Ranks& ranks, TileKeeper keeper,
                               const Progress& progress)
    : own_(own), ranks_(ranks), keeper_(keeper), progress_(progress) {}

SharedTileSink::~SharedTileSink() = default;

void SharedTileSink::start(const TileLayout& layout) {
  own_.start(layout);
  strips_.emplace(layout.strips);
  shares_.emplace(layout.strips, ranks_.size());
  tell_what_is_there();
  for (Index column = 0; column < strips_->size(); ++column) {
    for (Index row = 0; row <= column; ++row) {
      const double pairs = pairs_of(*strips_, row, column);
      total_ += pairs;
      if (ranks_.rank() == 0 && has(row, column)) done_ += pairs;
    }
  }
  receiver_ = std::jthread([this](const std::stop_token& stop) { receive_all(stop); });
}

void SharedTileSink::tell_what_is_there() {
  is_there_.assign(strips_->n_tiles(), 0);
  if (keeper_ != TileKeeper::first) return;
  if (ranks_.rank() == 0) {
    for (Index column = 0; column < strips_->size(); ++column) {
      for (Index row = 0; row <= column; ++row) {
        if (own_.has(row, column)) is_there_[Strips::tile(row, column)] = 1;
      }
    }
  }
  ranks_.broadcast(0, std::as_writable_bytes(std::span(is_there_)));
}

int SharedTileSink::keeper(Index row_strip, Index column_strip) const {
  return keeper_ == TileKeeper::first ? 0 : shares_->keeper(row_strip, column_strip);
}

bool SharedTileSink::owns(Index row_strip, Index column_strip) const {
  return shares_->maker(row_strip, column_strip) == ranks_.rank();
}

bool SharedTileSink::has(Index row_strip, Index column_strip) const {
  return is_there_[Strips::tile(row_strip, column_strip)] != 0;
}

void SharedTileSink::put(ExchangeTile tile) {
  if (has_failed_) {
    const std::lock_guard lock(mutex_);
    std::rethrow_exception(error_);
  }
  const double pairs = pairs_of(*strips_, tile.row_strip, tile.column_strip);
  const int to = keeper(tile.row_strip, tile.column_strip);
  if (to == ranks_.rank()) {
    own_.put(std::move(tile));
  } else {
    ranks_.send(to, Channel::tiles, encode_tile(tile));
  }
  count(pairs);
}

void SharedTileSink::count(double pairs) {
  const std::lock_guard lock(mutex_);
  done_ += pairs;
}

void SharedTileSink::show_progress() {
  double done = 0;
  {
    const std::lock_guard lock(mutex_);
    done = done_;
  }
  if (progress_.report) progress_.report("form factors", done, total_, "pairs");
}

void SharedTileSink::send_count(bool is_last) {
  const std::lock_guard telling(telling_);
  if (has_told_last_) return;
  has_told_last_ = is_last;
  PairCount count{0, is_last ? std::uint64_t{1} : 0};
  {
    const std::lock_guard lock(mutex_);
    std::swap(count.pairs, done_);
  }
  // Who has done nothing since says nothing, so that a rank that stands still can be told.
  if (count.pairs == 0 && !is_last) return;
  ranks_.send(0, Channel::tiles, std::as_bytes(std::span(&count, 1)));
}

void SharedTileSink::keep(ExchangeTile tile) {
  if (has_failed_) return;  // what is sent must be taken all the same
  try {
    own_.put(std::move(tile));
  } catch (...) {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
    has_failed_ = true;
  }
}

bool SharedTileSink::take(const Ranks::Message& message) {
  if (message.bytes.size() == sizeof(PairCount)) {
    PairCount told;
    std::memcpy(&told, message.bytes.data(), sizeof(told));
    count(told.pairs);
    return told.is_last == 0;
  }
  const RecordHeader header = record_header(message.bytes);
  keep(decode_tile(message.bytes, strips_->rows(header.row_strip),
                   strips_->rows(header.column_strip)));
  return true;
}

void SharedTileSink::receive_all(const std::stop_token& stop) {
  int n_working = ranks_.size() - 1;
  Clock::time_point told = Clock::now();
  const bool is_first_rank = ranks_.rank() == 0;
  if (is_first_rank) show_progress();
  while (n_working > 0 && !stop.stop_requested()) {
    const std::optional<Ranks::Message> message = ranks_.poll(Channel::tiles);
    if (message && !take(*message)) --n_working;
    if (Clock::now() - told >= kCountInterval) {
      told = Clock::now();
      is_first_rank ? show_progress() : send_count(false);
    }
    if (!message) std::this_thread::sleep_for(kNap);
  }
}

void SharedTileSink::finish() {
  if (ranks_.rank() > 0) send_count(true);
  const PairCount last{0, 1};
  for (int rank = 1; rank < ranks_.size(); ++rank) {
    if (rank == ranks_.rank()) continue;
    ranks_.send(rank, Channel::tiles, std::as_bytes(std::span(&last, 1)));
  }
  receiver_.join();
  if (ranks_.rank() == 0) show_progress();
  if (error_) std::rethrow_exception(error_);
}

void share_tiles(const WholeMesh& whole, const Visibility& visibility,
                 const TransportOptions& options, const Coverage& coverage, TileKeeper keeper,
                 TileSink& own) {
  SharedTileSink sink(own, *options.ranks, keeper, options.progress);
  TransportOptions quiet = options;
  quiet.progress.report = {};
  assemble_tiles(whole, visibility, quiet, coverage, sink);
  sink.finish();
}

}  // namespace radiosity
