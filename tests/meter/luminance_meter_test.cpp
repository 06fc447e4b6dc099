// Luminance from a viewpoint: of lamps, of what reflects their light, and of what hides it.
#include "radiosity/meter/luminance_meter.h"

#include <gtest/gtest.h>

#include <vector>

#include "radiosity/base/error.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "tests/meter/meter_room.h"

namespace radiosity {
namespace {

using test::MeterRoom;
using test::motion;

/// Surfaces are found by rays in single precision, 1e-6 of the room's size off.
constexpr double kOfRay = 1e-5;

/// 5 x 3 x 2.5 m, of three bands, with a lamp of 1 x 0.5 m below the ceiling and a screen, of which
/// the side towards x = 5 emits nothing.
struct Room : MeterRoom {
  explicit Room(const Eigen::Isometry3d& where) : MeterRoom(where) {
    scene.bands.kind = Bands::Kind::rgb;
    add_walls(Vec3(5, 3, 2.5), 4);
    add("lamp", Vec3(2, 1, 2.4), Vec3(0, 0.5, 0), Vec3(1, 0, 0), 2, 2);
    add("screen", Vec3(4, 1, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), 1, 1);
    const Index n = mesh.size();
    solution.exitance = Eigen::MatrixXd::Zero(n, 3);
    solution.reflectance = Eigen::MatrixXd::Zero(n, 3);
    for (Index i = 0; i < n; ++i) {
      const auto& name = mesh.surface_names[static_cast<std::size_t>(mesh.surface[i])];
      if (name == "lamp") solution.exitance.row(i) = emitted;
      if (name == "floor") solution.reflectance.row(i) = reflectance;
    }
    solution.radiosity = solution.exitance;
    for (Index i = 0; i < n; ++i) {
      const auto& name = mesh.surface_names[static_cast<std::size_t>(mesh.surface[i])];
      if (name == "ceiling") solution.radiosity.row(i) = reflected;
    }
  }

  [[nodiscard]] Eigen::RowVectorXd seen(const Vec3& eye, const Vec3& point) const {
    const Lighting light{scene, solution};
    const Visibility visibility(mesh);
    return LuminanceMeter(mesh, visibility, std::span(&light, 1), weights)
        .seen(place * eye, place * point);
  }

  Eigen::RowVector3d emitted{10, 20, 5};
  Eigen::RowVector3d reflectance{0.2, 0.4, 0.1};
  Eigen::RowVector3d reflected{1, 0.5, 3};
  Eigen::Vector3d weights{50, 120, 9};
};

TEST(LuminanceMeter, SeesWhatSurfacesSendHoweverTheRoomIsTurned) {
  for (const auto& place :
       {Eigen::Isometry3d::Identity(), motion(2, Vec3(3, 1, 1), Vec3(0, 9, 0))}) {
    const Room room(place);
    const Vec3 eye(0.5, 0.4, 1.6);
    const Vec3 up(0, 0, 1);
    const std::vector<Vec3> lamp{{2, 1, 2.4}, {2, 1.5, 2.4}, {3, 1.5, 2.4}, {3, 1, 2.4}};
    const std::vector<Vec3> ceiling{{0, 0, 2.5}, {0, 3, 2.5}, {5, 3, 2.5}, {5, 0, 2.5}};
    // The lamp's back is dark and hides the ceiling behind it, which at 0.1 m above it is its
    // perspective picture.
    const auto ceiling_factor = [&](const Vec3& x) {
      const double t = (2.5 - x.z()) / (2.4 - x.z());
      std::vector<Vec3> hidden;
      for (const Vec3& corner : lamp) hidden.emplace_back(x + t * (corner - x));
      return point_to_polygon(x, up, ceiling) - point_to_polygon(x, up, hidden);
    };
    for (const Vec3& x : {Vec3(1.1, 1.2, 0), Vec3(3.3, 0.3, 0), Vec3(2.4, 2.7, 0)}) {
      const Eigen::RowVectorXd found = room.seen(eye, x);
      const double direct = point_to_polygon(x, up, lamp) / kPi *
                            room.reflectance.cwiseProduct(room.emitted).dot(room.weights);
      // From the floor before it the screen hides walls only.
      const double indirect =
          ceiling_factor(x) / kPi * room.reflectance.cwiseProduct(room.reflected).dot(room.weights);
      EXPECT_NEAR(found[0], direct, kOfRay * direct);
      EXPECT_NEAR(found[1], indirect, kOfRay * indirect);
      // Along the line of sight it is all the same.
      EXPECT_NEAR(room.seen(eye, eye + 0.3 * (x - eye))[0], found[0], kOfRay * found[0]);
    }
    EXPECT_NEAR(room.seen(eye, Vec3(2.5, 1.2, 2.4))[0], room.emitted.dot(room.weights) / kPi,
                1e-12);
    // The front of the screen reflects nothing, its back neither, and both hide the floor.
    EXPECT_EQ(room.seen(Vec3(3, 1.5, 0.5), Vec3(4.5, 1.5, 0.01)).sum(), 0);
    EXPECT_EQ(room.seen(Vec3(4.9, 1.5, 0.5), Vec3(3, 1.5, 0)).sum(), 0);
  }
}

TEST(LuminanceMeter, MeasuresThePointsOfAGrid) {
  const Room room(Eigen::Isometry3d::Identity());
  GridPlan plan{.name = "floor"};
  plan.surface = "floor";
  plan.spacing = 1;
  plan.luminance_from = {Vec3(1, 1, 1.5), Vec3(4.5, 2, 1)};
  const Lighting light{room.scene, room.solution};
  const Visibility visibility(room.mesh);
  const Photometer photometer(room.mesh, std::span(&light, 1), room.weights);
  const GridLight measured = measure_grid(plan, room.mesh, visibility, photometer, {});
  const LuminanceMeter meter(room.mesh, visibility, std::span(&light, 1), room.weights);
  const auto found = measure_luminance(plan, measured, meter);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name_with_unit(), "luminance 1,1,1.5, cd/m²");
  for (Index k = 0; k < measured.where.size(); ++k) {
    const Vec3& x = measured.where.points[static_cast<std::size_t>(k)];
    EXPECT_EQ(found[1].values.row(k), meter.seen(plan.luminance_from[1], x));
  }
  plan.luminance_from = {measured.where.points.back()};
  EXPECT_THROW(measure_luminance(plan, measured, meter), SceneError);
}

}  // namespace
}  // namespace radiosity
