#include "apps/cluster/rank_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "tests/support/messages.h"

namespace {

using apps::RankWatch;
using namespace std::chrono_literals;

constexpr auto kBeat = 500ms;
constexpr int kSize = 4;

/// Seconds after which the watch of a rank complains, while `hears` tells it news in each beat;
/// none if it does not within ten minutes.
struct Complaint {
  double seconds = 0;
  std::string line;
};

std::optional<Complaint> complaint_of(
    RankWatch& watch, const std::function<void(RankWatch&, std::uint64_t beat)>& hears) {
  for (std::uint64_t beat = 0; beat < 1200; ++beat) {
    hears(watch, beat);
    if (const auto line = watch.pass(kBeat))
      return Complaint{0.5 * static_cast<double>(beat + 1), *line};
  }
  return std::nullopt;
}

TEST(RankWatch, IsQuietWhileSomeRankGetsOn) {
  for (int rank = 0; rank < kSize; ++rank) {
    RankWatch watch(rank, kSize);
    watch.set_patience(5s);
    const auto complaint = complaint_of(watch, [](RankWatch& own, std::uint64_t beat) {
      // One works, the others wait for it.
      for (int from = 0; from < kSize; ++from) own.hear(from, from == 2 ? 1 + beat : 7);
    });
    EXPECT_FALSE(complaint) << rank;
  }
}

TEST(RankWatch, FirstNamesWhoIsSilent) {
  for (int lost = 1; lost < kSize; ++lost) {
    RankWatch watch(0, kSize);
    watch.set_patience(10s);
    const auto complaint = complaint_of(watch, [lost](RankWatch& own, std::uint64_t beat) {
      for (int from = 0; from < kSize; ++from) {
        if (from != lost || beat < 40) own.hear(from, beat);
      }
    });
    ASSERT_TRUE(complaint) << lost;
    radiosity::test::expect_contains(complaint->line, "rank " + std::to_string(lost) + " of 4");
    EXPECT_GE(complaint->seconds, 30);
    EXPECT_LE(complaint->seconds, 31);
  }
}

TEST(RankWatch, OthersTakeTurnsWhereTheFirstIsSilent) {
  double before = 0;
  for (int rank = 1; rank < kSize; ++rank) {
    RankWatch watch(rank, kSize);
    watch.set_patience(10s);
    const auto complaint =
        complaint_of(watch, [rank](RankWatch& own, std::uint64_t) { own.hear(rank, 1); });
    ASSERT_TRUE(complaint);
    radiosity::test::expect_contains(complaint->line, "rank 0 of 4");
    EXPECT_GE(complaint->seconds, before + 1);
    EXPECT_LE(complaint->seconds, 20);
    before = complaint->seconds;
  }
}

TEST(RankWatch, FirstTellsThatNoneGetsOn) {
  RankWatch watch(0, kSize);
  watch.set_patience(10s);
  const auto complaint = complaint_of(watch, [](RankWatch& own, std::uint64_t beat) {
    for (int from = 0; from < kSize; ++from) own.hear(from, std::min(beat, std::uint64_t{14}));
  });
  ASSERT_TRUE(complaint);
  radiosity::test::expect_contains(complaint->line, "none of 4 ranks has got on");
  EXPECT_GE(complaint->seconds, 17);
  EXPECT_LE(complaint->seconds, 18);
}

TEST(RankWatch, ComplainsOnceAndNotWithoutPatience) {
  RankWatch watch(0, 2);
  EXPECT_FALSE(complaint_of(watch, [](RankWatch&, std::uint64_t) {})) << "0 is for ever";
  watch.set_patience(2s);
  EXPECT_TRUE(complaint_of(watch, [](RankWatch&, std::uint64_t) {}));
  EXPECT_FALSE(complaint_of(watch, [](RankWatch&, std::uint64_t) {}));
  RankWatch alone(0, 1);
  alone.set_patience(2s);
  EXPECT_FALSE(complaint_of(alone, [](RankWatch&, std::uint64_t) {}));
}

}  // namespace
