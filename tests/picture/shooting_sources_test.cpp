#include "radiosity/picture/shooting_sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr double kRounding = 1e-12;

/// A room with a box and a thin slab of two sides in it.
PatchMesh grouped_room() {
  PatchMesh mesh;
  test::add_box(mesh, {0, 0, 0}, {3, 2, 2}, 13, test::Facing::inwards);
  test::add_box(mesh, {1, .5, .5}, {1.5, 1, 1}, 5, test::Facing::outwards);
  test::make_two_sided(mesh, test::add_grid(mesh, {2, 1, 1}, {.5, .2, 0}, {0, 0, .5}, 4, 3));
  return mesh;
}

/// The first surface is bright.
std::vector<bool> bright_first(const PatchMesh& mesh) {
  std::vector<bool> result;
  for (const std::int32_t surface : mesh.surface) result.push_back(surface == 0);
  return result;
}

TEST(ShootingSources, PartitionThePatches) {
  const PatchMesh mesh = grouped_room();
  for (const Index largest : {1, 3, 20, 1000}) {
    const ShootingSources sources = make_shooting_sources(mesh, bright_first(mesh), largest);
    std::vector<int> count(mesh.size(), 0);
    for (const ShootingSources::Group& group : sources.groups) {
      const std::int32_t first = group.patches.front();
      const Index limit = mesh.surface[first] == 0 ? std::max<Index>(1, largest / 4) : largest;
      EXPECT_LE(static_cast<Index>(group.patches.size()), limit);
      for (const std::int32_t i : group.patches) {
        ++count[i];
        EXPECT_EQ(mesh.surface[i], mesh.surface[first]);
        EXPECT_NEAR(mesh.normal[i].dot(mesh.normal[first]), 1, kRounding);
        EXPECT_NEAR((mesh.centroid[i] - mesh.centroid[first]).dot(mesh.normal[first]), 0,
                    kRounding);
      }
    }
    EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](int c) { return c == 1; }));
  }
}

TEST(ShootingSources, NodesHoldTheirPatches) {
  const PatchMesh mesh = grouped_room();
  const ShootingSources sources = make_shooting_sources(mesh, bright_first(mesh), 20);
  for (std::size_t k = 0; k < sources.nodes.size(); ++k) {
    const ShootingSources::Node& node = sources.nodes[k];
    double area = 0;
    Vec3 moment = Vec3::Zero();
    for (auto part = static_cast<std::int32_t>(k); part < node.end; ++part) {
      const std::int32_t patch = sources.nodes[part].patch;
      if (patch < 0) continue;
      area += mesh.area[patch];
      moment += mesh.area[patch] * mesh.centroid[patch];
      for (int c = 0; c < mesh.n_corners(patch); ++c) {
        EXPECT_LE((mesh.corner(patch, c) - node.center).norm(), node.radius + kRounding);
      }
    }
    EXPECT_NEAR(node.area, area, kRounding);
    EXPECT_LE((node.center - moment / area).norm(), kRounding);
    const std::int32_t n_nodes = node.end - static_cast<std::int32_t>(k);
    EXPECT_EQ(node.patch >= 0, n_nodes == 1);
  }
}

TEST(ShootingSources, PointsLieApartInTheGroup) {
  const PatchMesh mesh = grouped_room();
  const ShootingSources sources = make_shooting_sources(mesh, bright_first(mesh), 20);
  for (const ShootingSources::Group& group : sources.groups) {
    const ShootingSources::Node& node = sources.nodes[group.node];
    const Vec3& normal = mesh.normal[group.patches.front()];
    for (int k = 0; k < ShootingSources::kPoints; ++k) {
      EXPECT_NEAR((group.points[k] - node.center).dot(normal), 0, kRounding);
      EXPECT_LT((group.points[k] - node.center).norm(), node.radius);
      for (int m = 0; m < k; ++m) EXPECT_GT((group.points[k] - group.points[m]).norm(), 0);
    }
  }
}

}  // namespace
}  // namespace radiosity
