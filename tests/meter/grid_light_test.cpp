#include "radiosity/meter/grid_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/meter/meter_room.h"

namespace radiosity {
namespace {

using test::MeterRoom;
using test::motion;

/// Sums of a few hundred form factors of angles near 1, and of a light of some 100 lx.
constexpr double kRounding = 1e-9;

/// Form factor from a point to a parallel rectangle at distance h with a corner straight above it,
/// of sides a, b, which may be negative (Hamilton & Morgan 1952).
double corner_factor(double a, double b, double h) {
  const double x = a / h;
  const double y = b / h;
  const double p = std::sqrt(1 + x * x);
  const double q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi);
}

/// A room of 5 x 3 x 2.5 m with a lamp of 1 x 0.5 m 0.1 m below the ceiling.
MeterRoom lamp_room(const Eigen::Isometry3d& place = Eigen::Isometry3d::Identity()) {
  MeterRoom room(place);
  room.add_walls(Vec3(5, 3, 2.5), 4);
  room.add("lamp", Vec3(2, 1, 2.4), Vec3(0, 0.5, 0), Vec3(1, 0, 0), 2, 2);
  room.shine("lamp", 1000, 0);
  return room;
}

/// From a point below its plane to that lamp.
double lamp_factor(const Vec3& x) {
  const double h = 2.4 - x.z();
  return corner_factor(3 - x.x(), 1.5 - x.y(), h) - corner_factor(2 - x.x(), 1.5 - x.y(), h) -
         corner_factor(3 - x.x(), 1 - x.y(), h) + corner_factor(2 - x.x(), 1 - x.y(), h);
}

GridLight measured(const MeterRoom& room, const GridPlan& plan,
                   const std::optional<Vec3>& down = {}) {
  return measure_grid(plan, room.mesh, Visibility(room.mesh), room.photometer(), down);
}

GridPlan work_plane() {
  GridPlan plan{.name = "plane"};
  plan.surface = "floor";
  plan.offset = 0.75;
  return plan;
}

TEST(GridLight, HasTheClosedFormBelowALampHoweverTheRoomIsTurned) {
  double first_mean = 0;
  double first_uniformity = 0;
  for (const auto& place :
       {Eigen::Isometry3d::Identity(), motion(0.7, Vec3::UnitZ(), Vec3(30, -5, 2)),
        motion(2, Vec3(3, 1, 1), Vec3(0, 80, 0))}) {
    const MeterRoom room = lamp_room(place);
    const GridLight light = measured(room, work_plane());
    const Eigen::Isometry3d back = place.inverse();
    for (Index k = 0; k < light.where.size(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      ASSERT_EQ(light.places[i], PointPlace::open);
      // The lamp's patches may be far enough to be interpolated, to 1e-4 of them.
      const double expected = 1000 * lamp_factor(back * light.where.points[i]);
      const double error = light.quantities[0].part(0, LightPart::error)[k];
      EXPECT_NEAR(light.quantities[0].part(0, LightPart::direct)[k], expected, error);
      EXPECT_LE(error, 1.001e-4 * expected);
      EXPECT_EQ(light.quantities[0].part(0, LightPart::indirect)[k], 0);
    }
    const GridSummary found = summary(light.places, light.quantities[0].total(0));
    if (first_mean == 0) {
      first_mean = found.mean;
      first_uniformity = found.least_to_mean();
    }
    EXPECT_NEAR(found.mean, first_mean, 2e-4 * first_mean);
    EXPECT_NEAR(found.least_to_mean(), first_uniformity, 4e-4);
    EXPECT_EQ(light.quantities[0].total(0)[found.least_at], found.least);
  }
}

// Where all around has the exitance B, all kinds of illuminance are B, up and down.
TEST(GridLight, IsTheSameOfAllKindsInAFurnace) {
  MeterRoom room;
  room.add_walls(Vec3(5, 3, 2.5), 3);
  for (const char* name : {"floor", "ceiling", "left", "right", "front", "rear"}) {
    room.shine(name, 30, 70);
  }
  GridPlan plan = work_plane();
  plan.spacing = 1;
  plan.is_cylindrical = true;
  plan.vertical = {Vec3(1, 0, 0), Vec3(0.6, 0, -0.8)};
  plan.semi_cylindrical = {Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)};
  const GridLight light = measured(room, plan);
  ASSERT_EQ(light.quantities.size(), 6U);
  for (const GridQuantity& quantity : light.quantities) {
    const double tolerance = quantity.name == "illuminance" ? 1e-4 * 100 : kRounding;
    for (Index k = 0; k < light.where.size(); ++k) {
      EXPECT_NEAR(quantity.total(0)[k], 100, tolerance) << quantity.name;
      EXPECT_NEAR(quantity.part(0, LightPart::direct)[k], 30, tolerance) << quantity.name;
    }
  }
}

// Against what the final gather has in many directions, in a room with a screen in the way: the
// mean over n azimuths of light from one side is off by π² / (3 n²) of it at most.
TEST(GridLight, HasTheCylinderAsTheMeanOfPlanes) {
  const auto place = motion(0.4, Vec3(1, -1, 2), Vec3(3, 4, 5));
  MeterRoom room = lamp_room(place);
  room.add("screen", Vec3(1.6, 1.2, 0.8), Vec3(0, 1, 0), Vec3(0, 0, 1), 2, 2);
  room.shine("lamp", 1000, 100);
  room.shine("floor", 0, 50);
  room.shine("left", 0, 20);
  GridPlan plan{.name = "points"};
  const Vec3 up = place.linear() * Vec3::UnitZ();
  for (const Vec3& x : {Vec3(1.4, 1.4, 1.2), Vec3(0.3, 2.5, 1.6), Vec3(2.5, 1.2, 0.7)}) {
    plan.points.push_back(place * x);
    plan.normals.push_back(up);
  }
  plan.up = up;
  plan.is_cylindrical = true;
  const Vec3 ahead = place.linear() * Vec3(0.8, 0.6, 0);
  plan.semi_cylindrical = {ahead};
  plan.vertical = {ahead, -ahead};
  const GridLight light = measured(room, plan);
  const Photometer photometer = room.photometer();
  constexpr int kDirections = 720;
  for (Index k = 0; k < 3; ++k) {
    const Vec3& point = plan.points[static_cast<std::size_t>(k)];
    double mean = 0;
    for (int d = 0; d < kDirections; ++d) {
      const Vec3 normal =
          Eigen::AngleAxisd(2 * kPi * d / kDirections, up) * (place.linear() * Vec3::UnitX());
      const Eigen::MatrixXd row = photometer.gather().irradiance(std::span(&point, 1), normal);
      mean += (row(0, 0) + row(0, 1)) / kDirections;
    }
    const Eigen::MatrixXd both = photometer.gather().irradiance(std::span(&point, 1), ahead);
    EXPECT_NEAR(light.quantities[1].total(0)[k], both(0, 0) + both(0, 1), kRounding);
    const double cylinder = light.quantities[3].total(0)[k];
    EXPECT_NEAR(cylinder, mean, square(kPi / kDirections) / 3 * mean);
    const double difference = light.quantities[1].total(0)[k] - light.quantities[2].total(0)[k];
    EXPECT_NEAR(light.quantities[4].total(0)[k], cylinder + difference / kPi, kRounding);
  }
}

// Points in a cupboard, in the wall, and beyond it count nothing; one on its top is measured.
TEST(GridLight, MasksSolidsAndWhatIsOutside) {
  MeterRoom room = lamp_room();
  test::add_box(room.mesh, Vec3(1, 1, 0), Vec3(1.5, 2, 1), 2, test::Facing::outwards);
  room.grow();
  GridPlan plan{.name = "points"};
  plan.points = {Vec3(1.2, 1.5, 0.5), Vec3(1.2, 1.5, 1), Vec3(4, 2, 0.8), Vec3(-1, 1, 1),
                 Vec3(7, 1, 4)};
  plan.normals.assign(5, Vec3::UnitZ());
  plan.is_cylindrical = true;
  const GridLight light = measured(room, plan, -Vec3::UnitZ());
  const std::vector<PointPlace> expected = {PointPlace::inside, PointPlace::open, PointPlace::open,
                                            PointPlace::outside, PointPlace::outside};
  EXPECT_EQ(light.places, expected);
  for (const GridQuantity& quantity : light.quantities) {
    EXPECT_EQ(quantity.total(0)[0], 0);
    EXPECT_EQ(quantity.total(0)[3], 0);
    EXPECT_GT(quantity.total(0)[1], 0);
  }
  EXPECT_NEAR(light.quantities[0].total(0)[1], 1000 * lamp_factor(plan.points[1]), kRounding);
  const GridSummary found = summary(light.places, light.quantities[0].total(0));
  EXPECT_EQ(found.n, 2);
  EXPECT_EQ(found.n_inside, 1);
  EXPECT_EQ(found.n_outside, 2);
}

// What looks sideways stands above the floor, though there is nothing behind it.
TEST(GridLight, FloorsAreBelowAndNotBehind) {
  MeterRoom room;
  room.add("floor", Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 2, 2);
  room.shine("floor", 100, 0);
  GridPlan plan{.name = "points"};
  plan.points = {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(5, 1, 1)};
  plan.normals = {Vec3::UnitX(), Vec3(-0.8, 0, 0.6), Vec3::UnitX()};
  const std::vector<PointPlace> expected = {PointPlace::open, PointPlace::open,
                                            PointPlace::outside};
  EXPECT_EQ(measured(room, plan, -Vec3::UnitZ()).places, expected);
  const GridLight everywhere = measured(room, plan);
  EXPECT_EQ(everywhere.places, std::vector<PointPlace>(3, PointPlace::open));
}

// A sun adds its direct light to planes and, as the mean over azimuths, to cylinders: E_n sinθ / π.
TEST(GridLight, HasTheSun) {
  MeterRoom room;
  room.add("floor", Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 2, 2);
  room.shine("floor", 0, 0);
  const double height = 35 * kPi / 180;
  room.scene.sun = Sun{.direction = -Vec3(std::cos(height), 0, std::sin(height)),
                       .irradiance = Eigen::VectorXd::Constant(1, 500)};
  GridPlan plan = work_plane();
  plan.is_cylindrical = true;
  plan.semi_cylindrical = {Vec3(1, 0, 0), Vec3(-1, 0, 0)};
  const GridLight light = measured(room, plan);
  const double cylinder = 500 * std::cos(height) / kPi;
  const double error = 1.001 * square(kPi / Photometer::kAzimuths) / 3 * cylinder;
  EXPECT_NEAR(light.quantities[0].total(0)[0], 500 * std::sin(height), kRounding);
  EXPECT_NEAR(light.quantities[1].total(0)[0], cylinder, error);
  EXPECT_NEAR(light.quantities[2].total(0)[0], 2 * cylinder, error);
  EXPECT_NEAR(light.quantities[3].total(0)[0], 0, error);
}

}  // namespace
}  // namespace radiosity
