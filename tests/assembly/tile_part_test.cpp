#include "radiosity/assembly/tile_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace radiosity {
namespace {

/// Strips of 1 to 64 rows.
Strips random_strips(Index n_strips, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<Index> rows(1, 64);
  std::vector<Index> boundaries{0};
  for (Index k = 0; k < n_strips; ++k) boundaries.push_back(boundaries.back() + rows(random));
  return Strips(boundaries);
}

TEST(TilePart, EachTileIsOfOnePart) {
  for (const Index n_strips : {1, 2, 3, 8, 31}) {
    const Strips strips = random_strips(n_strips, static_cast<std::uint64_t>(n_strips));
    for (const std::size_t n_parts : {1U, 2U, 3U, 7U, 16U, 40U}) {
      SCOPED_TRACE(testing::Message() << n_strips << " strips, " << n_parts << " parts");
      for (Index column = 0; column < n_strips; ++column) {
        for (Index row = 0; row <= column; ++row) {
          int n_owners = 0;
          for (std::size_t k = 0; k < n_parts; ++k) {
            if (TilePart(strips, {k, n_parts}).owns(row, column)) ++n_owners;
          }
          ASSERT_EQ(n_owners, 1) << row << ", " << column;
        }
      }
    }
  }
}

TEST(TilePart, StripsFollowEachOther) {
  const Strips strips = random_strips(50, 3);
  Index next = 0;
  for (std::size_t k = 0; k < 7; ++k) {
    const auto [first, last] = TilePart(strips, {k, 7}).strips();
    EXPECT_EQ(first, next);
    EXPECT_GE(last, first);
    next = last;
  }
  EXPECT_EQ(next, strips.size());
}

// Of s equal strips each has itself and (s - 1) / 2 others, half a tile more or less where s is
// even; parts of equally many strips therefore differ by half a tile a strip at most.
TEST(TilePart, PartsHaveEquallyManyTiles) {
  for (const Index n_strips : {24, 25 * 24}) {
    std::vector<Index> boundaries(n_strips + 1);
    for (Index k = 0; k <= n_strips; ++k) boundaries[k] = 64 * k;
    const Strips strips(boundaries);
    constexpr std::size_t kParts = 8;
    const double of_each = static_cast<double>(strips.n_tiles()) / kParts;
    for (std::size_t k = 0; k < kParts; ++k) {
      const TilePart part(strips, {k, kParts});
      Index n = 0;
      for (Index column = 0; column < n_strips; ++column) {
        for (Index row = 0; row <= column; ++row) n += part.owns(row, column) ? 1 : 0;
      }
      EXPECT_NEAR(static_cast<double>(n), of_each, 0.5 * static_cast<double>(n_strips) / kParts);
    }
  }
}

}  // namespace
}  // namespace radiosity
