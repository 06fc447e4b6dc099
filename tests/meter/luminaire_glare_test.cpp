#include "radiosity/meter/luminaire_glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/meter/meter_room.h"

namespace radiosity {
namespace {

using test::MeterRoom;

/// An isotropic luminaire of 500 cd, its opening 0.6 m x 0.3 m, turned so that C0 is along y.
void hang(MeterRoom& room, const Vec3& position, std::array<int, 2> divisions = {1, 1}) {
  Photometry photometry;
  photometry.web.polar = {0, kPi};
  photometry.web.azimuth = {0};
  photometry.web.intensity = Eigen::MatrixXd::Constant(2, 1, 500);
  photometry.along_c0 = 0.6;
  photometry.along_c90 = 0.3;
  room.scene.photometries = {photometry};
  Luminaire luminaire;
  luminaire.name = "lamp";
  luminaire.position = position;
  luminaire.axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  luminaire.divisions = divisions;
  luminaire.dimming = 0.5;
  luminaire.watts_per_lumen = Eigen::VectorXd::Ones(1);
  room.scene.luminaires = {luminaire};
}

TEST(ProjectedOpening, IsThatOfABoxAndACylinder) {
  Photometry box;
  box.along_c0 = 0.6;
  box.along_c90 = 0.3;
  box.height = 0.1;
  EXPECT_NEAR(projected_opening(box, Vec3::UnitZ()), 0.18, 1e-15);
  EXPECT_NEAR(projected_opening(box, Vec3::UnitX()), 0.03, 1e-15);
  EXPECT_NEAR(projected_opening(box, -Vec3::UnitY()), 0.06, 1e-15);
  EXPECT_NEAR(projected_opening(box, Vec3(1, 1, 1) / std::sqrt(3)), 0.27 / std::sqrt(3), 1e-15);
  Photometry can;
  can.along_c0 = can.along_c90 = 0.2;
  can.height = 0.5;
  can.is_round = true;
  EXPECT_NEAR(projected_opening(can, Vec3(0, 0.6, -0.8)), kPi * 0.01 * 0.8 + 0.1 * 0.6, 1e-15);
}

TEST(LuminaireGlare, IsTheClosedFormOfOneLuminaire) {
  MeterRoom room;
  room.add("floor", Vec3(-5, -5, 0), Vec3(10, 0, 0), Vec3(0, 10, 0), 2, 2);
  hang(room, Vec3(3, 0.5, 2.2));
  const Observer observer{.name = "eye", .position = Vec3(0, 0, 1.2), .direction = Vec3::UnitX()};
  const LuminaireGlare glare(room.scene, room.mesh, Eigen::VectorXd::Ones(1));
  const auto sources = glare.sources(observer);
  ASSERT_EQ(sources.size(), 1U);
  const double distance = std::sqrt(9 + 0.25 + 1);
  const double area = 0.18 * 1 / distance;
  EXPECT_EQ(sources[0].surface, "lamp");
  EXPECT_NEAR(sources[0].luminance, 250 / area, 1e-9);
  EXPECT_NEAR(sources[0].solid_angle, area / square(distance), 1e-15);
  EXPECT_NEAR(*sources[0].position, *position_index(Vec3(3, 0.5, 1), Vec3::UnitX(), Vec3::UnitZ()),
              1e-12);
  EXPECT_EQ(glare.n_without_opening(), 0);

  Observer behind = observer;
  behind.direction = -Vec3::UnitX();
  EXPECT_TRUE(glare.sources(behind).empty());
}

// A wall in the way hides it; one that ends half-way of its length leaves half of its points.
TEST(LuminaireGlare, SeesWhatIsHidden) {
  const Observer observer{.name = "eye", .position = Vec3(0, 0, 1.2), .direction = Vec3::UnitX()};
  for (const double end : {2.0, 0.0}) {
    MeterRoom room;
    room.add("wall", Vec3(1.5, -2, 0), Vec3(0, 2 + end, 0), Vec3(0, 0, 3), 1, 1);
    hang(room, Vec3(3, 0, 2.2), {6, 3});
    const LuminaireGlare glare(room.scene, room.mesh, Eigen::VectorXd::Ones(1));
    const auto sources = glare.sources(observer);
    if (end > 0) {
      EXPECT_TRUE(sources.empty());
      continue;
    }
    ASSERT_EQ(sources.size(), 1U);
    const double distance = std::sqrt(10.0);
    EXPECT_NEAR(sources[0].solid_angle, 0.5 * 0.18 / std::pow(distance, 3), 1e-15);
  }
}

TEST(LuminaireGlare, CountsThoseWithoutAnOpening) {
  MeterRoom room;
  room.add("floor", Vec3(-5, -5, 0), Vec3(10, 0, 0), Vec3(0, 10, 0), 2, 2);
  hang(room, Vec3(3, 0, 2));
  room.scene.photometries[0].along_c0 = 0;
  const LuminaireGlare glare(room.scene, room.mesh, Eigen::VectorXd::Ones(1));
  EXPECT_EQ(glare.n_without_opening(), 1);
  const Observer observer{.name = "eye", .position = Vec3(0, 0, 1.2), .direction = Vec3::UnitX()};
  EXPECT_TRUE(glare.sources(observer).empty());
}

}  // namespace
}  // namespace radiosity
