#include "radiosity/picture/measured_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;

/// Sums of a few hundred form factors, each with some roundings of 1.1e-16 of angles near 1.
constexpr double kPointRounding = 1e-12;

/// Form factor from a point to a parallel rectangle at distance h with a corner straight above it,
/// of sides a, b, which may be negative (Hamilton & Morgan 1952).
double corner_factor(double a, double b, double h) {
  const double x = a / h;
  const double y = b / h;
  const double p = std::sqrt(1 + x * x);
  const double q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi);
}

/// From a point at (x, y) to the rectangle [x0, x1] x [y0, y1] at distance h.
double rectangle_factor(double x, double y, double x0, double x1, double y0, double y1, double h) {
  return corner_factor(x1 - x, y1 - y, h) - corner_factor(x0 - x, y1 - y, h) -
         corner_factor(x1 - x, y0 - y, h) + corner_factor(x0 - x, y0 - y, h);
}

/// A black room of 4 m x 3 m x 2.5 m, z up, with a lamp of 1 m x 1 m below its ceiling. Returns the
/// radiosity: of the lamp 2 and 5, of the room 0.
struct LampRoom {
  LampRoom() {
    add_box(mesh, Vec3::Zero(), Vec3(4, 3, 2.5), 2, Facing::inwards);
    n_room = mesh.size();
    add_grid(mesh, Vec3(1, 1, 2.25), Vec3(0, 1, 0), Vec3(1, 0, 0), 5, 5);
  }
  /// Of all patches but the lamp's 0, also of what is added later.
  [[nodiscard]] Eigen::MatrixXd radiosity() const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(mesh.size(), 2);
    result.block(n_room, 0, 25, 2).rowwise() = Eigen::RowVector2d(2, 5);
    return result;
  }
  [[nodiscard]] MeasuredGrid measured(const PointGrid& grid) const {
    const FinalGather gather(mesh, radiosity());
    return measure(gather, Visibility(mesh), grid, -grid.normal());
  }
  PatchMesh mesh;
  Index n_room = 0;
};

TEST(MeasuredGrid, IsTheClosedFormBelowASquareLamp) {
  const LampRoom room;
  const PointGrid grid = make_work_plane(room.mesh, Vec3::UnitZ(), {.height = 0.75});
  ASSERT_GT(grid.size(), 50);
  const MeasuredGrid measured = room.measured(grid);
  Eigen::VectorXd expected(grid.size());
  for (Index k = 0; k < grid.size(); ++k) {
    const Vec3 point = grid.point(k);
    EXPECT_EQ(point.z(), 0.75);
    EXPECT_EQ(measured.places[static_cast<std::size_t>(k)], PointPlace::open);
    expected[k] = rectangle_factor(point.x(), point.y(), 1, 2, 1, 2, 1.5);
    EXPECT_NEAR(measured.irradiance(k, 0), 2 * expected[k], kPointRounding);
    EXPECT_NEAR(measured.irradiance(k, 1), 5 * expected[k], kPointRounding);
  }
  const GridSummary found = summary(measured.places, measured.irradiance.col(1));
  EXPECT_EQ(found.n, grid.size());
  EXPECT_NEAR(found.mean, 5 * expected.mean(), kPointRounding);
  EXPECT_NEAR(found.least_to_mean(), expected.minCoeff() / expected.mean(), kPointRounding);
  EXPECT_NEAR(found.least_to_greatest(), expected.minCoeff() / expected.maxCoeff(), kPointRounding);
}

// A pillar on the floor casts a shadow, and the points in it have no light of their own.
TEST(MeasuredGrid, LeavesOutPointsInSolids) {
  LampRoom room;
  add_box(room.mesh, Vec3(2.4, 1, 0), Vec3(3.2, 1.8, 2), 2, Facing::outwards);
  const PointGrid grid = make_work_plane(room.mesh, Vec3::UnitZ(), {.spacing = 0.2});
  ASSERT_EQ(grid.size(), 20 * 15);
  const MeasuredGrid measured = room.measured(grid);
  const GridSummary found = summary(measured.places, measured.irradiance.col(0));
  EXPECT_EQ(found.n_inside, 4 * 4);  // middles of cells from 2.5 to 3.1 and from 1.1 to 1.7
  EXPECT_EQ(found.n_outside, 0);
  EXPECT_EQ(found.n, grid.size() - found.n_inside);
  EXPECT_EQ(found.least, 0);  // right behind it
  for (Index k = 0; k < grid.size(); ++k) {
    const Vec3 point = grid.point(k);
    const bool is_in_pillar =
        point.x() > 2.4 && point.x() < 3.2 && point.y() > 1 && point.y() < 1.8;
    EXPECT_EQ(measured.places[static_cast<std::size_t>(k)],
              is_in_pillar ? PointPlace::inside : PointPlace::open);
    if (point.x() >= 2.4) continue;  // on the lamp's side nothing is in the way
    EXPECT_NEAR(measured.irradiance(k, 0),
                2 * rectangle_factor(point.x(), point.y(), 1, 2, 1, 2, 1.5), kPointRounding);
  }
}

// Beyond the walls of a room that is no rectangle there is no floor. A plane as high as a table's
// top is measured on it.
TEST(MeasuredGrid, LeavesOutWhatIsBeyondTheFloor) {
  const PatchMesh mesh =
      meshing::make_patches(io::read_scene(RADIOSITY_SCENES "/l-room.json"), {.n_patches = 300});
  const Floor floor = find_floor(mesh, Vec3::UnitZ());
  ASSERT_TRUE(floor.is_found);
  double area = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.normal[i].z() > 0.999 && std::abs(mesh.centroid[i].z() - floor.level) < 1e-6) {
      area += mesh.area[i];
    }
  }
  const PointGrid grid = make_work_plane(mesh, Vec3::UnitZ(), {.height = 1.5, .spacing = 0.25});
  const FinalGather gather(mesh, Eigen::MatrixXd::Ones(mesh.size(), 1));
  const MeasuredGrid measured = measure(gather, Visibility(mesh), grid, -Vec3::UnitZ());
  const GridSummary found = summary(measured.places, measured.irradiance.col(0));
  EXPECT_GT(found.n_outside, 0);
  // What the border of the floor cuts off of cells along it.
  const double cell = grid.column.norm() * grid.row.norm();
  const double length = 2 * (floor.box.sizes().x() + floor.box.sizes().y());
  EXPECT_NEAR(static_cast<double>(found.n) * cell, area, 0.5 * length * 0.25);
}

TEST(PointGrid, FollowsTheFloorAndTheStandard) {
  // 0.2 * 5^(lg d): the table in EN 12464-1 has 0.2 m for 1 m, 1 m for 10 m and 5 m for 100 m.
  EXPECT_NEAR(largest_spacing(1, 0.6), 0.2, 1e-12);
  EXPECT_NEAR(largest_spacing(10, 6), 1, 1e-12);
  EXPECT_NEAR(largest_spacing(100, 60), 5, 1e-12);
  EXPECT_NEAR(largest_spacing(10, 1), 0.2, 1e-12);  // a corridor
  PatchMesh mesh;
  add_box(mesh, Vec3(1, 2, 3), Vec3(5, 8, 6), 2, Facing::inwards);
  add_box(mesh, Vec3(2, 3, 3), Vec3(4, 4, 5), 1, Facing::outwards);  // less area facing upwards
  for (const Vec3& up : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitY()), Vec3(-Vec3::UnitX())}) {
    const PointGrid grid =
        make_work_plane(mesh, up, {.height = 0.5, .border = 0.25, .spacing = 0.3});
    EXPECT_EQ(grid.normal(), up);
    EXPECT_LE(grid.column.norm(), 0.3);
    EXPECT_LE(grid.row.norm(), 0.3);
    const double level = up.z() > 0 ? 3.5 : up.y() > 0 ? 2.5 : -4.5;
    Box3 box;
    for (Index k = 0; k < grid.size(); ++k) {
      EXPECT_NEAR(up.dot(grid.point(k)), level, 1e-12);
      box.extend(grid.point(k));
    }
    const Vec3 half = 0.5 * (grid.column + grid.row);
    for (int c = 0; c < 3; ++c) {
      if (up[c] != 0) continue;
      EXPECT_NEAR(box.min()[c] - std::abs(half[c]), Vec3(1, 2, 3)[c] + 0.25, 1e-12);
      EXPECT_NEAR(box.max()[c] + std::abs(half[c]), Vec3(5, 8, 6)[c] - 0.25, 1e-12);
    }
  }
  EXPECT_THROW(make_work_plane(mesh, Vec3::UnitZ(), {.border = 2}), SceneError);
  EXPECT_THROW(make_work_plane(mesh, Vec3::UnitZ(), {.spacing = 1e-6}), SceneError);
}

}  // namespace
}  // namespace radiosity
