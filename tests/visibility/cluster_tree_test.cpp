#include "radiosity/visibility/cluster_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "radiosity/base/parallel.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr double kTreeThickness = 1e-10;
constexpr Index kLeaf = 8;

/// A room with a box in it, so many patches that the tree is built in parallel.
PatchMesh large_room() {
  PatchMesh mesh;
  test::add_box(mesh, {-2, -2, -2}, {2, 2, 2}, 40, test::Facing::inwards);
  test::add_box(mesh, {-1.1, -0.7, -0.9}, {0.6, 0.8, 1.3}, 12, test::Facing::outwards);
  return mesh;
}

void expect_equal(const Cluster& a, const Cluster& b) {
  EXPECT_EQ(a.begin, b.begin);
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.left, b.left);
  EXPECT_EQ(a.right, b.right);
  EXPECT_EQ(a.box.min(), b.box.min());
  EXPECT_EQ(a.box.max(), b.box.max());
  EXPECT_EQ(a.outline, b.outline);
  EXPECT_EQ(a.is_flat, b.is_flat);
  ASSERT_EQ(a.plane.has_value(), b.plane.has_value());
  if (a.plane) {
    EXPECT_EQ(a.plane->normal, b.plane->normal);
    EXPECT_EQ(a.plane->offset, b.plane->offset);
  }
}

TEST(ClusterTree, IsTheSameAtAnyNumberOfThreads) {
  const PatchMesh mesh = large_room();
  ASSERT_GT(mesh.size(), 10000);
  const ThreadLimit three(3);
  const ClusterTree tree = make_cluster_tree(mesh, kLeaf, kTreeThickness);
  const ThreadLimit one(1);
  const ClusterTree serial = make_cluster_tree(mesh, kLeaf, kTreeThickness);
  EXPECT_EQ(tree.order, serial.order);
  EXPECT_EQ(tree.leaves, serial.leaves);
  ASSERT_EQ(tree.clusters.size(), serial.clusters.size());
  for (std::size_t k = 0; k < tree.clusters.size(); ++k) {
    expect_equal(tree.clusters[k], serial.clusters[k]);
  }
}

TEST(ClusterTree, ParentsComeBeforeLeftAndRightHalves) {
  const PatchMesh mesh = large_room();
  const ClusterTree tree = make_cluster_tree(mesh, kLeaf, kTreeThickness);
  ASSERT_EQ(tree.clusters.front().end, mesh.size());
  Index next = 0;  // of the patches in leaves
  for (std::size_t k = 0; k < tree.clusters.size(); ++k) {
    const Cluster& cluster = tree.clusters[k];
    if (cluster.is_leaf()) {
      EXPECT_EQ(cluster.begin, next);
      EXPECT_LE(cluster.end - cluster.begin, kLeaf);
      next = cluster.end;
      continue;
    }
    const Cluster& left = tree.clusters[cluster.left];
    const Cluster& right = tree.clusters[cluster.right];
    EXPECT_EQ(cluster.left, static_cast<std::int32_t>(k) + 1);
    EXPECT_EQ(left.begin, cluster.begin);
    EXPECT_EQ(left.end, right.begin);
    EXPECT_EQ(right.end, cluster.end);
  }
  EXPECT_EQ(next, mesh.size());
  std::vector<std::int32_t> patches = tree.order;
  std::sort(patches.begin(), patches.end());
  for (std::int32_t i = 0; i < mesh.size(); ++i) EXPECT_EQ(patches[i], i);
}

TEST(ClusterTree, OutlinesHoldTheirPatches) {
  const PatchMesh mesh = large_room();
  const ClusterTree tree = make_cluster_tree(mesh, kLeaf, kTreeThickness);
  for (const Cluster& cluster : tree.clusters) {
    if (!cluster.plane || cluster.outline.size() == 8) continue;
    const Vec3& normal = cluster.plane->normal;
    for (Index k = cluster.begin; k < cluster.end; ++k) {
      for (int c = 0; c < mesh.n_corners(tree.order[k]); ++c) {
        const Vec3& corner = mesh.corner(tree.order[k], c);
        for (std::size_t e = 0; e < cluster.outline.size(); ++e) {
          const Vec3& a = cluster.outline[e];
          const Vec3& b = cluster.outline[(e + 1) % cluster.outline.size()];
          const double twice_area = normal.dot((b - a).cross(corner - a));
          EXPECT_GE(twice_area, -8 * kTreeThickness * (b - a).norm());
        }
      }
    }
  }
}

}  // namespace
}  // namespace radiosity
