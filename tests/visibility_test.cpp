#include "radiosity/visibility.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace radiosity {
namespace {

/// Appends an axis-parallel rectangle a + s u + t v, s, t in [0, 1], facing u x v.
void add_rectangle(PatchMesh& mesh, const Vec3& a, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, a + u, a + u + v, a + v});
  mesh.add_patch({first, first + 1, first + 2, first + 3}, 0,
                 static_cast<std::int32_t>(mesh.size()));
}

PatchMesh opposed_squares_with_screen(double size, const Vec3& origin) {
  PatchMesh mesh;
  add_rectangle(mesh, origin, Vec3(size, 0, 0), Vec3(0, size, 0));
  add_rectangle(mesh, origin + Vec3(0, 0, size), Vec3(0, size, 0), Vec3(size, 0, 0));
  add_rectangle(mesh, origin + Vec3(0, 0, size / 2), Vec3(size / 2, 0, 0), Vec3(0, size, 0));
  return mesh;
}

class VisibilityAtScale : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(VisibilityAtScale, ScreenBlocksItsHalf) {
  const auto [size, offset] = GetParam();
  const Vec3 origin = Vec3::Constant(offset);
  const PatchMesh mesh = opposed_squares_with_screen(size, origin);
  const Visibility visibility(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.001, 0.999);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vec3> from;
    std::vector<Vec3> to;
    std::uint32_t expected = 0;
    for (unsigned k = 0; k < Visibility::kPacket; ++k) {
      const double x0 = uniform(random);
      const double x1 = uniform(random);
      if (std::abs((x0 + x1) / 2 - 0.5) < 1e-3) continue;
      expected |= static_cast<std::uint32_t>((x0 + x1) / 2 < 0.5) << from.size();
      from.push_back(origin + size * Vec3(x0, uniform(random), 0));
      to.push_back(origin + size * Vec3(x1, uniform(random), 1));
    }
    EXPECT_EQ(visibility.blocked(from, to, 0, 1), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, VisibilityAtScale,
                         testing::Values(std::pair{1.0, 0.0}, std::pair{1e-6, 0.0},
                                         std::pair{1e6, 0.0}, std::pair{1.0, 1e7}));

TEST(Visibility, PatchesDoNotBlockThemselvesOrTheirPlane) {
  PatchMesh mesh;
  add_rectangle(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  add_rectangle(mesh, Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));  // beside, same plane
  add_rectangle(mesh, Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));  // shares an edge
  const Visibility visibility(mesh);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::array from{Vec3(uniform(random), uniform(random), 0)};
    const std::array to{Vec3(0, uniform(random), uniform(random))};
    EXPECT_EQ(visibility.blocked(from, to, 0, 2), 0U);
  }
}

TEST(Visibility, NothingLeaksThroughSharedEdges) {
  // A screen of 64 x 64 quads between two squares: no segment may slip through at shared edges.
  constexpr int kCells = 64;
  PatchMesh mesh;
  add_rectangle(mesh, Vec3(0.25, 0.25, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0));
  add_rectangle(mesh, Vec3(0.25, 0.25, 1), Vec3(0, 0.5, 0), Vec3(0.5, 0, 0));
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const auto corner = [](int a, int b) {
        return Vec3(a / double(kCells), b / double(kCells), 0.5 + 0.1 * (a * 37 % 11) / 11.0);
      };
      const auto first = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {corner(i, j), corner(i + 1, j),
                                                 corner(i + 1, j + 1), corner(i, j + 1)});
      mesh.add_patch({first, first + 1, first + 2, first + 3}, 0, 0);
    }
  }
  const Visibility visibility(mesh);
  for (int k = 0; k < 20000; ++k) {
    // Aim exactly at vertices and edges of the screen.
    const Vec3 target(double(16 + k % 33) / kCells, 0.25 + 0.5 * (k * 7919 % 20000) / 20000.0, 0);
    const std::array from{Vec3(target.x(), target.y(), 0)};
    const std::array to{Vec3(target.x(), target.y(), 1)};
    ASSERT_EQ(visibility.blocked(from, to, 0, 1), 1U) << target.transpose();
  }
}

TEST(Visibility, FirstHitTellsSideAndDistance) {
  const PatchMesh mesh = opposed_squares_with_screen(1, Vec3::Zero());
  const Visibility visibility(mesh);
  const auto front = visibility.first_hit(Vec3(0.75, 0.5, 0), Vec3(0, 0, 2), 0);
  ASSERT_TRUE(front.has_value());
  EXPECT_EQ(front->patch, 1);
  EXPECT_TRUE(front->front);
  EXPECT_NEAR(front->distance, 1, 1e-6);
  const auto back = visibility.first_hit(Vec3(0.25, 0.5, 0), Vec3(0, 0, 2), 0);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->patch, 2);
  EXPECT_FALSE(back->front);
  EXPECT_FALSE(visibility.first_hit(Vec3(0.5, 0.5, 0), Vec3(0, 0, -1), 0).has_value());
}

TEST(Visibility, FirstFrontHitPassesThroughBacks) {
  PatchMesh mesh = opposed_squares_with_screen(1, Vec3::Zero());
  {
    const Visibility visibility(mesh);
    // The screen faces up: from below one looks through it, from above one sees it.
    const auto through = visibility.first_front_hit(Vec3(0.25, 0.5, 0.1), Vec3(0, 0, 1));
    ASSERT_TRUE(through.has_value());
    EXPECT_EQ(through->patch, 1);
    EXPECT_EQ(visibility.first_front_hit(Vec3(0.25, 0.5, 0.9), Vec3(0, 0, -1))->patch, 2);
  }
  // A second polygon in the same place, facing down: now there is something to see from below.
  add_rectangle(mesh, Vec3(0, 0, 0.5), Vec3(0, 1, 0), Vec3(0.5, 0, 0));
  const Visibility visibility(mesh);
  EXPECT_EQ(visibility.first_front_hit(Vec3(0.25, 0.5, 0.1), Vec3(0, 0, 1))->patch, 3);
  EXPECT_EQ(visibility.first_front_hit(Vec3(0.25, 0.5, 0.9), Vec3(0, 0, -1))->patch, 2);
}

TEST(Visibility, EmptyMeshHasNoHits) {
  const Visibility visibility{PatchMesh{}};
  EXPECT_FALSE(visibility.first_hit(Vec3::Zero(), Vec3(1, 0, 0)).has_value());
}

}  // namespace
}  // namespace radiosity
