#include "radiosity/exchange/exchange_evaluator.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <utility>

#include "meshing/patches/patches.h"
#include "radiosity/assembly/block_walk.h"
#include "tests/support/hung_boxes.h"

namespace radiosity {
namespace {

/// A room with boxes hung in it, ready to be asked.
struct Room {
  explicit Room(std::uint64_t seed)
      : mesh(meshing::make_patches(test::make_hung_boxes(seed), {.n_patches = 100})),
        visibility(mesh),
        coverage(find_coverage(mesh, plane_thickness(mesh))),
        evaluator(mesh, visibility, coverage, {.tolerance = 1e-2}) {}

  PatchMesh mesh;
  Visibility visibility;
  Coverage coverage;
  ExchangeEvaluator evaluator;
};

using Entries = std::map<std::pair<Index, Index>, ExchangeArea>;

Entries entries_between(const ExchangeEvaluator& evaluator, std::int32_t a, std::int32_t b,
                        const Between& between) {
  Entries entries;
  auto worker = evaluator.worker();
  evaluator.visit_block(a, b, between, worker, [&](Index row, Index column, const ExchangeArea& f) {
    const bool is_new = entries.emplace(std::pair(row, column), f).second;
    EXPECT_TRUE(is_new) << row << ", " << column;
  });
  return entries;
}

/// Inherited candidates leave out only what is not in the way.
TEST(ExchangeEvaluator, ABlockHasTheEntriesOfItsPairs) {
  int n_certain = 0;
  int n_uncertain = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Room room(seed);
    const ExchangeEvaluator& evaluator = room.evaluator;
    const Entries entries = entries_between(evaluator, 0, 0, evaluator.everything());
    auto worker = evaluator.worker();
    for (Index row = 0; row < evaluator.size(); ++row) {
      for (Index column = row + 1; column < evaluator.size(); ++column) {
        const std::int32_t i = evaluator.tree().order[row];
        const std::int32_t j = evaluator.tree().order[column];
        const ExchangeArea alone = evaluator.entry(i, j, evaluator.between(i, j), worker);
        const ExchangeArea swapped = evaluator.entry(j, i, evaluator.between(j, i), worker);
        EXPECT_EQ(alone.value, swapped.value);
        EXPECT_EQ(alone.error, swapped.error);
        const auto found = entries.find({row, column});
        const ExchangeArea inherited = found == entries.end() ? ExchangeArea{} : found->second;
        // What is proved with few candidates may take rays with many.
        const double sigma = 6 * (alone.error + inherited.error);
        EXPECT_NEAR(inherited.value, alone.value, sigma + 1e-9 * alone.value + 1e-15)
            << "seed " << seed << ", " << i << ", " << j;
        ++(inherited.is_certain ? n_certain : n_uncertain);
      }
    }
  }
  EXPECT_GT(n_certain, 10000);
  EXPECT_GT(n_uncertain, 1000);
}

TEST(ExchangeEvaluator, CountsWhatBecameOfEachPair) {
  const Room room(3);
  auto worker = room.evaluator.worker();
  std::int64_t n_entries = 0;
  room.evaluator.visit_block(0, 0, room.evaluator.everything(), worker,
                             [&](Index, Index, const ExchangeArea&) { ++n_entries; });
  const Census& census = worker.census;
  EXPECT_EQ(census.facing, census.visible + census.hidden + census.undecided);
  EXPECT_LE(census.partial, census.undecided);
  EXPECT_GE(n_entries, census.visible + census.partial);
  EXPECT_LE(n_entries, census.visible + census.undecided);
  EXPECT_GT(census.visible, 0);
  EXPECT_GT(census.hidden, 0);
  EXPECT_GT(census.undecided, 0);
}

/// Takes clusters of at most so many patches as a whole and keeps all entries.
class Collector final : public BlockVisitor {
 public:
  Collector(const ExchangeEvaluator& evaluator, Index size) : evaluator_(evaluator), size_(size) {}
  [[nodiscard]] bool is_whole(std::int32_t k) const override {
    const Cluster& cluster = evaluator_.tree().clusters[k];
    return cluster.is_leaf() || cluster.end - cluster.begin <= size_;
  }
  [[nodiscard]] bool wants(std::int32_t, std::int32_t) const override { return true; }
  void visit(std::int32_t a, std::int32_t b, std::span<const Between> between) override {
    ASSERT_EQ(between.size(), 1U);
    const Entries block = entries_between(evaluator_, a, b, between[0]);
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(blocks_.emplace(a, b).second) << "twice";
    for (const auto& [place, entry] : block) {
      EXPECT_TRUE(entries_.emplace(place, entry).second);
    }
  }
  [[nodiscard]] const Entries& entries() const { return entries_; }

 private:
  const ExchangeEvaluator& evaluator_;
  Index size_;
  std::mutex mutex_;
  std::set<std::pair<std::int32_t, std::int32_t>> blocks_;
  Entries entries_;
};

TEST(BlockWalk, VisitsEachPairOnceHoweverLargeTheBlocks) {
  const Room room(2);
  const Entries whole = entries_between(room.evaluator, 0, 0, room.evaluator.everything());
  for (const Index size : {1, 16, 64, 1000}) {
    Collector collector(room.evaluator, size);
    walk_blocks(room.evaluator, collector);
    ASSERT_EQ(collector.entries().size(), whole.size()) << size;
    for (const auto& [place, entry] : whole) {
      const auto found = collector.entries().find(place);
      ASSERT_NE(found, collector.entries().end());
      EXPECT_EQ(found->second.value, entry.value);
      EXPECT_EQ(found->second.error, entry.error);
    }
  }
}

TEST(BlockWalk, LeavesOutWhatIsNotWanted) {
  const Room room(2);
  class Nothing final : public BlockVisitor {
   public:
    [[nodiscard]] bool is_whole(std::int32_t) const override { return true; }
    [[nodiscard]] bool wants(std::int32_t, std::int32_t) const override { return false; }
    void visit(std::int32_t, std::int32_t, std::span<const Between>) override { FAIL(); }
  } nothing;
  walk_blocks(room.evaluator, nothing);
}

}  // namespace
}  // namespace radiosity
