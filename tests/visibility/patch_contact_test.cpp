/// Which patches touch elsewhere than edge to edge.

#include "radiosity/visibility/patch_contact.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::add_grid;

constexpr double kReach = 1e-9;

/// A unit square in the floor and a parallelogram a + s u + t v.
bool touches_the_floor(const Vec3& a, const Vec3& u, const Vec3& v) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  add_grid(mesh, a, u, v, 1, 1);
  const PatchContact contact(mesh, kReach);
  const Contact result = contact.between(0, 1);
  EXPECT_EQ(contact.between(1, 0), result);
  return result != Contact::none;
}

TEST(PatchContact, EdgesThatMeetAreNone) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  EXPECT_FALSE(touches_the_floor({0, 0, 0}, y, z)) << "a wall on its edge";
  EXPECT_FALSE(touches_the_floor({0, 0.2, 0}, 0.5 * y, z)) << "on a part of it";
  EXPECT_FALSE(touches_the_floor({1, 0, 0}, x, y)) << "more of the floor";
  EXPECT_FALSE(touches_the_floor({0, 0, 2 * kReach}, x, y)) << "a lid beyond the reach";
  EXPECT_FALSE(touches_the_floor({1.5, 0.5, -0.5}, x, z)) << "their planes cross elsewhere";
}

TEST(PatchContact, FindsWhatStandsCrossesOrLiesWithin) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  EXPECT_TRUE(touches_the_floor({0.5, 0, 0}, y, z)) << "a wall on its middle";
  EXPECT_TRUE(touches_the_floor({0.5, 0.2, -0.5}, 0.5 * y, z)) << "through it";
  EXPECT_TRUE(touches_the_floor({0.5, 0.2, kReach / 2}, 0.5 * y, z)) << "within reach";
  EXPECT_FALSE(touches_the_floor({0.5, 0.2, 2 * kReach}, 0.5 * y, z)) << "above it";
  EXPECT_TRUE(touches_the_floor({0.5, 0.5, 0}, x, y)) << "a sheet that covers a corner";
  EXPECT_TRUE(touches_the_floor({0.5, 0.5, kReach / 2}, y, x)) << "and one that faces down";
}

TEST(PatchContact, EdgesPointInwards) {
  PatchMesh mesh;
  add_grid(mesh, {1, 2, 3}, {2, 0, 0}, {0, 1, 1}, 1, 1);
  const PatchContact contact(mesh, kReach);
  for (int k = 0; k < 4; ++k) {
    const Vec3 in = contact.inwards(0, k);
    EXPECT_NEAR(in.norm(), 1, 1e-15);
    EXPECT_GT(in.dot(mesh.centroid[0] - contact.corner(0, k)), 0);
    EXPECT_NEAR(in.dot(contact.corner(0, k + 1) - contact.corner(0, k)), 0, 1e-15);
  }
}

}  // namespace
