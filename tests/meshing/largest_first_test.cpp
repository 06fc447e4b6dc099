/// A heap of numbers against sorting them.

#include "meshing/patches/largest_first.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace {

using meshing::LargestFirst;

TEST(LargestFirst, TakesOutTheLargestAndOfEqualOnesTheLeastIndex) {
  std::mt19937 random(7);
  LargestFirst heap;
  std::vector<std::pair<double, int>> expected;  // negated sizes, so that they sort alike
  const auto take = [&] {
    std::sort(expected.begin(), expected.end());
    const LargestFirst::Item item = heap.pop();
    EXPECT_EQ(std::pair(-item.size, item.index), expected.front());
    expected.erase(expected.begin());
  };
  for (int index = 0; index < 500; ++index) {
    // Few sizes, so that many are equal.
    const double size = static_cast<double>(random() % 20);
    heap.push({size, index});
    expected.emplace_back(-size, index);
    if (random() % 3 == 0) take();
  }
  while (!heap.is_empty()) take();
  EXPECT_TRUE(expected.empty());
}

}  // namespace
