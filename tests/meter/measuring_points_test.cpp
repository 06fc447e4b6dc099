#include "radiosity/meter/measuring_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/base/error.h"
#include "tests/meter/meter_room.h"

namespace radiosity {
namespace {

using test::MeterRoom;
using test::motion;

GridPlan above_floor(double offset = 0.75) {
  GridPlan plan{.name = "plane"};
  plan.surface = "floor";
  plan.offset = offset;
  return plan;
}

GridPlan rectangle(double width, double height) {
  GridPlan plan{.name = "rectangle"};
  plan.sides = {Vec3(width, 0, 0), Vec3(0, height, 0)};
  return plan;
}

// p = 0.2 · 5^lg d: 0.2 m at 1 m and 1 m at 10 m are EN 12464-1's own examples of the formula; d is
// the shorter side where the longer one is twice as long or more.
TEST(MeasuringPoints, AreThoseOfTheStandard) {
  struct Case {
    double width, height, spacing;
    Index n_columns, n_rows;
  };
  const PatchMesh none;
  for (const Case& c : {Case{1, 1, 0.2, 5, 5}, Case{10, 8, 1, 10, 8}, Case{10, 5, 0.6160, 17, 9},
                        Case{0.4, 0.3, 0.1054, 4, 3}, Case{3, 2, 0.4310, 7, 5},
                        Case{100, 80, 5, 20, 16}, Case{1000, 900, 10, 100, 90}}) {
    const MeasuringPoints points = make_measuring_points(rectangle(c.width, c.height), none);
    const double d = c.width >= 2 * c.height ? c.height : c.width;
    EXPECT_NEAR(points.spacing, std::min(10.0, 0.2 * std::pow(5, std::log10(d))), 1e-12);
    EXPECT_NEAR(points.spacing, c.spacing, 1e-4);
    EXPECT_EQ(points.grid->n_columns, c.n_columns);
    EXPECT_EQ(points.grid->n_rows, c.n_rows);
    EXPECT_EQ(points.size(), c.n_columns * c.n_rows);
    EXPECT_EQ(points.border, 0);
  }
  EXPECT_EQ(standard_border(10, 8), 0.5);
  EXPECT_NEAR(standard_border(10, 2), 0.3, 1e-15);
}

TEST(MeasuringPoints, TurnAndMoveWithTheRoom) {
  for (const auto& place :
       {Eigen::Isometry3d::Identity(), motion(0.3, Vec3::UnitZ(), Vec3(100, -20, 3)),
        motion(2.1, Vec3(1, 2, -0.5), Vec3(-7, 0, 1))}) {
    MeterRoom room(place);
    room.add_walls(Vec3(5, 3, 2.8), 3);
    const MeasuringPoints points = make_measuring_points(above_floor(), room.mesh);
    EXPECT_NEAR(points.border, 0.45, 1e-9);
    const Eigen::Isometry3d back = place.inverse();
    Vec3 mean = Vec3::Zero();
    for (Index k = 0; k < points.size(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3 x = back * points.points[i];
      mean += x / static_cast<double>(points.size());
      EXPECT_NEAR(x.z(), 0.75, 1e-9);
      EXPECT_GT(x.x(), 0.45);
      EXPECT_LT(x.x(), 5 - 0.45);
      EXPECT_GT(x.y(), 0.45);
      EXPECT_LT(x.y(), 3 - 0.45);
      EXPECT_LT((place.linear() * Vec3::UnitZ() - points.normals[i]).norm(), 1e-12);
      EXPECT_FALSE(points.is_off[i]);
    }
    EXPECT_LT((mean - Vec3(2.5, 1.5, 0.75)).norm(), 1e-9);
    EXPECT_EQ(points.size(), 8 * 4);  // 4.1 m and 2.1 m by 0.536 m
    EXPECT_LT((points.grid->normal() - points.normals.front()).norm(), 1e-12);
  }
}

TEST(MeasuringPoints, KnowWhereTheSurfaceEnds) {
  MeterRoom room;
  room.add("floor", Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 1, 0), 2, 2);
  room.add("more", Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), 2, 2);
  for (auto& surface : room.mesh.surface) surface = 0;  // an L of 4 x 1 and 1 x 2
  GridPlan plan = above_floor();
  plan.border = 0;
  plan.spacing = 0.5;
  const MeasuringPoints points = make_measuring_points(plan, room.mesh);
  ASSERT_EQ(points.size(), 8 * 6);
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    EXPECT_EQ(points.is_off[i], points.points[i].x() > 1 && points.points[i].y() > 1);
  }
}

TEST(MeasuringPoints, RefuseWhatCannotBe) {
  MeterRoom room;
  room.add_walls(Vec3(2, 1, 1), 1);
  room.add("roof", Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 0), 1, 1);
  room.add("half", Vec3(1, 0, 2), Vec3(1, 0, -1), Vec3(0, 1, 0), 1, 1);
  for (auto& surface : room.mesh.surface) surface = std::min(surface, 6);
  const auto error = [&](const GridPlan& plan) -> std::string {
    try {
      (void)make_measuring_points(plan, room.mesh);
    } catch (const SceneError& problem) {
      return problem.what();
    }
    return "";
  };
  GridPlan plan = above_floor();
  plan.surface = "table";
  EXPECT_EQ(error(plan), "grid \"plane\": no surface \"table\"");
  plan.surface = "roof";
  EXPECT_NE(error(plan).find("is not flat"), std::string::npos) << error(plan);
  plan = above_floor();
  plan.border = 0.5;
  EXPECT_NE(error(plan).find("leaves nothing"), std::string::npos) << error(plan);
  plan = rectangle(1, 1);
  plan.spacing = 1e-3;
  EXPECT_NE(error(plan).find("would be more than 100000"), std::string::npos) << error(plan);
}

}  // namespace
}  // namespace radiosity
