// What `inspect` calls closed by rays is what the form factors say.

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/compressed/make_transport.h"
#include "radiosity/exchange/openings.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::Facing;

void expect_closed(const PatchMesh& mesh, bool expected) {
  constexpr double kTolerance = 1e-2;
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = kTolerance});
  EXPECT_EQ(transport->report().closed, expected);
  EXPECT_EQ(is_enclosed(mesh, visibility, kTolerance, 0), expected);
}

PatchMesh room(int n) {
  PatchMesh mesh;
  test::add_box(mesh, Vec3(0, 0, 0), Vec3(4, 3, 2.5), n, Facing::inwards);
  return mesh;
}

TEST(Enclosure, RoomsAreClosed) {
  expect_closed(room(1), true);
  expect_closed(room(3), true);
}

TEST(Enclosure, SolidsInRoomsLeaveThemClosed) {
  PatchMesh mesh = room(2);
  test::add_box(mesh, Vec3(1, 1, 0.5), Vec3(2, 2, 1), 1, Facing::outwards);
  expect_closed(mesh, true);
}

/// Every edge of a box is shared by two polygons, but from outside it is open.
TEST(Enclosure, SolidsAreOpen) {
  PatchMesh mesh;
  test::add_box(mesh, Vec3(0, 0, 0), Vec3(1, 1, 1), 2, Facing::outwards);
  expect_closed(mesh, false);
}

/// Walls that share no edges with the floor: T-vertices.
TEST(Enclosure, EdgesNeedNotBeShared) {
  PatchMesh mesh;
  const Vec3 x(1, 0, 0);
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  test::add_grid(mesh, Vec3(0, 0, 0), x, y, 3, 3);
  test::add_grid(mesh, Vec3(0, 0, 1), y, x, 2, 2);
  test::add_grid(mesh, Vec3(0, 0, 0), z, x, 1, 1);
  test::add_grid(mesh, Vec3(0, 1, 0), x, z, 5, 1);
  test::add_grid(mesh, Vec3(0, 0, 0), y, z, 4, 1);
  test::add_grid(mesh, Vec3(1, 0, 0), z, y, 1, 2);
  expect_closed(mesh, true);
}

TEST(Enclosure, ALidWithAHoleIsOpen) {
  PatchMesh mesh;
  const Vec3 x(1, 0, 0);
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  test::add_grid(mesh, Vec3(0, 0, 0), x, y, 1, 1);
  test::add_grid(mesh, Vec3(0, 0, 1), 0.7 * y, x, 1, 1);
  test::add_grid(mesh, Vec3(0, 0, 0), z, x, 1, 1);
  test::add_grid(mesh, Vec3(0, 1, 0), x, z, 1, 1);
  test::add_grid(mesh, Vec3(0, 0, 0), y, z, 1, 1);
  test::add_grid(mesh, Vec3(1, 0, 0), z, y, 1, 1);
  expect_closed(mesh, false);
}

/// The back of a one-sided sheet takes light that no row has.
TEST(Enclosure, BacksOpenARoom) {
  PatchMesh mesh = room(1);
  test::add_grid(mesh, Vec3(1, 1, 2), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  expect_closed(mesh, false);
}

TEST(Enclosure, NothingEnclosesNothing) {
  const PatchMesh mesh;
  EXPECT_FALSE(is_enclosed(mesh, Visibility(mesh), 1e-2, 0));
}

}  // namespace
