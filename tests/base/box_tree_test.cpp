#include "radiosity/base/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

std::vector<Box3> random_boxes(int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);  // NOLINT: fixed seed
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Box3> boxes;
  for (int k = 0; k < n; ++k) {
    const Vec3 low(uniform(random), uniform(random), uniform(random));
    const Vec3 size(uniform(random), uniform(random), uniform(random));
    boxes.emplace_back(low, low + 0.05 * size);
  }
  return boxes;
}

std::vector<std::int32_t> found(const BoxTree& tree, const Box3& box) {
  std::vector<std::int32_t> result;
  tree.for_each_meeting(box, [&](std::int32_t k) { result.push_back(k); });
  return result;
}

TEST(BoxTree, FindsWhatMeetsABoxInTheSameOrderAtAnyNumberOfThreads) {
  for (const int n : {0, 1, 5, 300, 30000}) {
    const std::vector<Box3> boxes = random_boxes(n, 1);
    const ThreadLimit three(3);
    const BoxTree tree(boxes);
    const ThreadLimit one(1);
    const BoxTree serial(boxes);
    for (const Box3& asked : random_boxes(100, 2)) {
      std::vector<std::int32_t> meeting = found(tree, asked);
      EXPECT_EQ(meeting, found(serial, asked)) << n;
      std::sort(meeting.begin(), meeting.end());
      std::vector<std::int32_t> expected;
      for (std::int32_t k = 0; k < n; ++k) {
        if (boxes[k].intersects(asked)) expected.push_back(k);
      }
      EXPECT_EQ(meeting, expected) << n;
    }
  }
}

TEST(BoxTree, FindsAroundGroupsWhatItFindsAroundEachOfThem) {
  const std::vector<Box3> boxes = random_boxes(3000, 3);
  const BoxTree tree(boxes);
  constexpr std::int32_t kMost = 32;
  std::vector<int> n_seen(boxes.size(), 0);
  for (const BoxTree::Group group : tree.groups(kMost)) {
    EXPECT_LE(tree.members(group).size(), static_cast<std::size_t>(kMost));
    const std::vector<std::int32_t> near = found(tree, tree.box(group));
    for (const std::int32_t k : tree.members(group)) {
      ++n_seen[k];
      std::vector<std::int32_t> meeting;
      for (const std::int32_t other : near) {
        if (boxes[other].intersects(boxes[k])) meeting.push_back(other);
      }
      EXPECT_EQ(meeting, found(tree, boxes[k]));
    }
  }
  EXPECT_EQ(n_seen, std::vector<int>(boxes.size(), 1));
}

}  // namespace
}  // namespace radiosity
