#include "apps/cluster/rank_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps {
namespace {

/// The ranks after the first wait one after the other for it, so that one of them tells.
constexpr auto kTurn = std::chrono::milliseconds(1500);
constexpr int kMostTurns = 4;

double seconds(RankWatch::Duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

RankWatch::RankWatch(int rank, int size)
    : rank_(rank), size_(size), silence_(size, Duration(0)), progress_(size, 0) {}

void RankWatch::hear(int from, std::uint64_t progress) {
  silence_[from] = Duration(0);
  if (progress != progress_[from]) standstill_ = Duration(0);
  progress_[from] = progress;
}

bool RankWatch::is_over(Duration silence, int rank) const {
  const int turns = rank == 0 ? std::min(rank_ - 1, kMostTurns) : 0;
  return silence > patience_ + turns * kTurn;
}

std::optional<std::string> RankWatch::pass(Duration time) {
  for (Duration& silence : silence_) silence += time;
  standstill_ += time;
  if (patience_ == Duration(0) || has_told_ || size_ == 1) return std::nullopt;
  // The others hear of the first alone.
  const int end = rank_ == 0 ? size_ : 1;
  for (int rank = 0; rank < end; ++rank) {
    if (rank == rank_ || !is_over(silence_[rank], rank)) continue;
    has_told_ = true;
    return fmt::format("rank {} of {} has died or hangs: nothing was heard of it for {:.0f} s",
                       rank, size_, seconds(patience_));
  }
  if (rank_ != 0 || standstill_ <= patience_) return std::nullopt;
  has_told_ = true;
  return fmt::format("none of {} ranks has got on for {:.0f} s", size_, seconds(patience_));
}

}  // namespace apps
