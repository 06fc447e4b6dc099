#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace apps {

/// Judges from what ranks tell of themselves every now and then whether one has died or hangs. The
/// first rank hears all others, and each of these the first. Knows no clock: it is told how much
/// time has gone by.
class RankWatch {
 public:
  using Duration = std::chrono::steady_clock::duration;

  RankWatch(int rank, int size);

  /// How long none may be silent, and all may stand still; 0: for ever.
  void set_patience(Duration patience) { patience_ = patience; }
  /// A rank, this one too, has told how far it has got: a number that grows with its work.
  void hear(int from, std::uint64_t progress);
  /// Time has gone by. Returns, once, what is wrong.
  [[nodiscard]] std::optional<std::string> pass(Duration time);

 private:
  [[nodiscard]] bool is_over(Duration silence, int rank) const;

  int rank_;
  int size_;
  Duration patience_{0};
  std::vector<Duration> silence_;        // of each rank
  std::vector<std::uint64_t> progress_;  // of each rank
  Duration standstill_{0};               // of all together
  bool has_told_ = false;
};

}  // namespace apps
