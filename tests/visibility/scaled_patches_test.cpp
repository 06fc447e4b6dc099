/// What rays meet: patches in single precision, and which of them count.

#include "radiosity/visibility/scaled_patches.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::add_box;
using test::add_grid;
using test::Facing;

TEST(ScaledPatches, FillTheUnitBallWhereverTheSceneLies) {
  PatchMesh mesh;
  add_box(mesh, {1000, 2000, -500}, {1003, 2001, -498}, 2, Facing::inwards);
  const ScaledPatches patches(mesh);
  double furthest = 0;
  const auto triangles = patches.triangles(mesh);
  for (const auto& [x, y, z] : triangles[0].vertices) {
    furthest = std::max(furthest, static_cast<double>(std::sqrt(x * x + y * y + z * z)));
  }
  EXPECT_NEAR(furthest, 1, 1e-6);
  EXPECT_EQ(triangles[0].patch.size(), 2U * mesh.size());
  EXPECT_TRUE(triangles[1].patch.empty());
}

TEST(ScaledPatches, NeedlesAreApart) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  add_grid(mesh, Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY() / 1000, 1, 1);
  const auto triangles = ScaledPatches(mesh).triangles(mesh);
  EXPECT_EQ(triangles[0].patch, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(triangles[1].patch, (std::vector<std::int32_t>{1, 1}));
}

TEST(ScaledPatches, TwinsAreThereOnceAndHaveNoBack) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  test::make_two_sided(mesh, 0);
  add_grid(mesh, Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  const ScaledPatches patches(mesh);
  EXPECT_EQ(patches.triangles(mesh)[0].patch, (std::vector<std::int32_t>{0, 0, 2, 2}));
  EXPECT_FALSE(patches.is_back(0, Vec3::UnitZ()));
  EXPECT_TRUE(patches.is_back(2, Vec3::UnitZ()));
  EXPECT_FALSE(patches.is_back(2, -Vec3::UnitZ()));
}

TEST(ScaledPatches, EndsTheirBacksAndTheirPlanesDoNotBlock) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  test::make_two_sided(mesh, 0);
  add_grid(mesh, Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  add_grid(mesh, {0, 0, 1e-3}, Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  add_grid(mesh, Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  const ScaledPatches patches(mesh);
  EXPECT_TRUE(patches.ignores(0, 0, 4));
  EXPECT_TRUE(patches.ignores(1, 0, 4)) << "its back";
  EXPECT_TRUE(patches.ignores(2, 0, 4)) << "beside it in its plane";
  EXPECT_FALSE(patches.ignores(3, 0, 4)) << "just above";
  EXPECT_TRUE(patches.ignores(4, 0, 4));
  EXPECT_FALSE(patches.ignores(2, -1, 4));
}

}  // namespace
