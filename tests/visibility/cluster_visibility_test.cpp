#include "radiosity/visibility/cluster_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "radiosity/visibility/prepared_mesh.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

/// A room with boxes in it, some of which touch a wall or each other.
PatchMesh cluttered_room(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  PatchMesh mesh;
  test::add_box(mesh, {-2, -2, -2}, {2, 2, 2}, 12, test::Facing::inwards);
  for (int k = 0; k < 12; ++k) {
    const Vec3 size =
        0.2 * Vec3::Ones() + 0.9 * Vec3(uniform(random), uniform(random), uniform(random));
    Vec3 low = -1.9 * Vec3::Ones();
    for (int axis = 0; axis < 3; ++axis) low[axis] += uniform(random) * (3.8 - size[axis]);
    if (k % 3 == 0) low[k % 2] = -2;
    test::add_box(mesh, low, low + size, 2, test::Facing::outwards);
  }
  return mesh;
}

/// The blockers that nodes are made of.
std::vector<bool> blockers_of(const BlockerSet& set, const Candidates& nodes) {
  std::vector<bool> result(set.blockers.size(), false);
  Candidates open = nodes;
  while (!open.empty()) {
    const BlockerSet::Node& node = set.nodes[open.back()];
    open.pop_back();
    if (node.is_leaf()) {
      result[node.blocker] = true;
    } else {
      open.push_back(node.left);
      open.push_back(node.right);
    }
  }
  return result;
}

/// No segment between patches of two clusters that face each other may meet what was left out, and
/// each has to meet something where all are said to be blocked.
TEST(ClusterVisibility, SegmentsDoNotDisagree) {
  constexpr double kInside = 1e-6;
  std::array<int, 2> n_segments{};  // kept something, hidden
  long n_left_out = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 random(seed);
    const PatchMesh mesh = cluttered_room(random);
    const PreparedMesh prepared(mesh);
    const BlockerSet& set = prepared.blockers;
    const auto& clusters = prepared.tree.clusters;
    for (int trial = 0; trial < 12000; ++trial) {
      // Every other one a leaf: only small clusters are hidden as a whole.
      const auto pick = [&]() -> const Cluster& {
        const auto& leaves = prepared.tree.leaves;
        return clusters[trial % 2 == 0 ? leaves[random() % leaves.size()]
                                       : random() % clusters.size()];
      };
      const Cluster& a = pick();
      const Cluster& b = pick();
      if (are_averted(a, b, prepared.thickness)) continue;
      const auto kept = possible_blockers(a, b, set, all_candidates(set), prepared.thickness);
      const std::vector<bool> is_kept =
          kept ? blockers_of(set, *kept) : std::vector<bool>(set.blockers.size(), true);
      n_left_out += std::count(is_kept.begin(), is_kept.end(), false);
      for (int ray = 0; ray < 4; ++ray) {
        const auto any_of = [&](const Cluster& c) {
          return prepared.tree.order[c.begin + static_cast<Index>(random() % (c.end - c.begin))];
        };
        const std::int32_t i = any_of(a);
        const std::int32_t j = any_of(b);
        const Vec3 from = test::random_point(prepared.polygons[i].points(), random);
        const Vec3 to = test::random_point(prepared.polygons[j].points(), random);
        const auto is_in_front = [&](std::int32_t patch, const Vec3& point) {
          const HalfSpace& plane = prepared.planes[patch];
          return plane.normal.dot(point) - plane.offset > kInside;
        };
        if (!is_in_front(i, to) || !is_in_front(j, from)) continue;
        bool is_blocked = false;
        for (std::size_t k = 0; k < set.blockers.size(); ++k) {
          ASSERT_FALSE(set.blockers[k].is_flat());
          if (test::length_inside(set.blockers[k].faces, from, to) <= kInside) continue;
          is_blocked = true;
          EXPECT_TRUE(is_kept[k]) << "seed " << seed << ", trial " << trial << ", blocker " << k;
        }
        ++n_segments[kept ? 0 : 1];
        EXPECT_TRUE(kept || is_blocked) << "seed " << seed << ", trial " << trial;
      }
    }
  }
  EXPECT_GT(n_segments[0], 10000);
  EXPECT_GT(n_segments[1], 500);
  EXPECT_GT(n_left_out, 100000);
}

/// Clusters that are told to lie behind each other have no two patches in front of each other.
TEST(ClusterVisibility, AvertedClustersDoNotFaceEachOther) {
  std::mt19937_64 random(1);  // NOLINT: fixed seed
  const PatchMesh mesh = cluttered_room(random);
  const PreparedMesh prepared(mesh);
  int n_averted = 0;
  for (const Cluster& a : prepared.tree.clusters) {
    for (const Cluster& b : prepared.tree.clusters) {
      const bool is_averted = are_averted(a, b, prepared.thickness);
      EXPECT_EQ(is_averted, are_averted(b, a, prepared.thickness));
      if (!is_averted) continue;
      ++n_averted;
      for (Index r = a.begin; r < a.end; ++r) {
        for (Index c = b.begin; c < b.end; ++c) {
          const std::int32_t i = prepared.tree.order[r];
          const std::int32_t j = prepared.tree.order[c];
          const auto sees = [&](std::int32_t from, std::int32_t to) {
            const ConvexPolygon& polygon = prepared.polygons[to];
            return std::any_of(polygon.begin(), polygon.end(), [&](const Vec3& corner) {
              return prepared.planes[from].normal.dot(corner) - prepared.planes[from].offset > 1e-9;
            });
          };
          EXPECT_FALSE(sees(i, j) && sees(j, i)) << i << ", " << j;
        }
      }
    }
  }
  EXPECT_GT(n_averted, 1000);
}

}  // namespace
}  // namespace radiosity
