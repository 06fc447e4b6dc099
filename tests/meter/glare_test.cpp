#include "radiosity/meter/glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/meter/meter_room.h"

namespace radiosity {
namespace {

using test::MeterRoom;
using test::motion;

// Points of Guth's curve worked out by hand: σ and τ are 45° at height = distance ahead (τ = 0) and
// at as much aside (τ = 90°).
TEST(PositionIndex, IsGuths) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 z = Vec3::UnitZ();
  EXPECT_EQ(position_index(x, x, z), 1);
  EXPECT_NEAR(*position_index(Vec3(1, 0, 1), x, z),
              std::exp((35.2 - 1.22) * 1e-3 * 45 + 21e-5 * 2025), 1e-12);
  EXPECT_NEAR(*position_index(Vec3(1, 1, 0), x, z),
              std::exp((35.2 - 0.31889 * 90 - 1.22 * std::exp(-20.0)) * 1e-3 * 45 +
                       (21 + 0.26667 * 90 - 0.002963 * 8100) * 1e-5 * 2025),
              1e-12);
  // To both sides, above and below, whatever the length.
  for (const Vec3& d : {Vec3(2, 1, 0.5), Vec3(2, -1, 0.5), Vec3(4, 2, -1)}) {
    EXPECT_NEAR(*position_index(d, x, z), *position_index(Vec3(2, 1, 0.5), x, z), 1e-12);
  }
  EXPECT_FALSE(position_index(Vec3(-1, 0, 0.1), x, z));
  EXPECT_FALSE(position_index(Vec3(1, 0, 1.91), x, z));
  EXPECT_FALSE(position_index(Vec3(1, 3.01, 0), x, z));
}

// A small lamp ahead and above, in a room that reflects evenly: L_b is the exitance of the walls
// over π but for what the lamp covers, which shines as bright here.
TEST(Glare, IsTheClosedFormOfOneSource) {
  for (const auto& place :
       {Eigen::Isometry3d::Identity(), motion(1.1, Vec3(1, 2, 3), Vec3(9, -4, 2))}) {
    MeterRoom room(place);
    room.add_walls(Vec3(6, 4, 3), 2);
    for (const char* name : {"floor", "ceiling", "left", "right", "front", "rear"}) {
      room.shine(name, 0, 150);
    }
    // A square of 0.2 m at (5, 2, 2.2) that looks along -x; the eye at (1, 2, 1.2).
    room.add("lamp", Vec3(5, 1.9, 2.1), Vec3(0, 0, 0.2), Vec3(0, 0.2, 0), 2, 2);
    room.grow();
    room.shine("lamp", 20000, 150);
    const Observer observer{.name = "eye",
                            .position = place * Vec3(1, 2, 1.2),
                            .direction = place.linear() * Vec3::UnitX(),
                            .up = place.linear() * Vec3::UnitZ()};
    const Glare glare = find_glare(observer, room.mesh, room.photometer());
    ASSERT_EQ(glare.sources.size(), 1U);
    const GlareSource& source = glare.sources.front();
    EXPECT_EQ(source.surface, "lamp");
    EXPECT_NEAR(source.luminance, 20000 / kPi, 1e-9);
    // From corner to corner: Ω = Σ ± atan(x y / (d sqrt(d² + x² + y²))).
    const auto corner = [](double y, double z) {
      return std::atan(y * z / (4 * std::sqrt(16 + y * y + z * z)));
    };
    const double omega =
        corner(0.1, 1.1) - corner(-0.1, 1.1) - corner(0.1, 0.9) + corner(-0.1, 0.9);
    EXPECT_NEAR(source.solid_angle, omega, 1e-12);
    EXPECT_NEAR(glare.background, 150 / kPi, 1e-9);
    EXPECT_NEAR(glare.luminance, 150 / kPi, 1e-9);  // of the wall ahead
    // The middle is at a slope of 1/4, but for the lamp's extent.
    const double p = *position_index(Vec3(4, 0, 1), Vec3::UnitX(), Vec3::UnitZ());
    EXPECT_NEAR(*source.position, p, 2e-3 * p);
    const double expected = 8 * std::log10(0.25 / glare.background *
                                           square(source.luminance / *source.position) * omega);
    EXPECT_NEAR(*glare.ugr(), expected, 1e-12);
  }
}

// Two lamps of one surface are two sources, each of all its patches; behind a screen half of one.
TEST(Glare, TellsSourcesApartAndSeesWhatIsHidden) {
  MeterRoom room;
  room.add_walls(Vec3(6, 4, 3), 2);
  room.add("lamp", Vec3(5, 1, 2.5), Vec3(0, 0, 0.3), Vec3(0, 0.3, 0), 3, 3);
  room.add("lamp", Vec3(5, 2.7, 2.5), Vec3(0, 0, 0.3), Vec3(0, 0.3, 0), 3, 3);
  for (auto& surface : room.mesh.surface) surface = std::min(surface, 6);
  room.shine("lamp", 5000, 0);
  room.shine("floor", 0, 100);
  const Observer observer{.name = "eye", .position = Vec3(1, 2, 1.2), .direction = Vec3::UnitX()};
  const Glare open = find_glare(observer, room.mesh, room.photometer());
  ASSERT_EQ(open.sources.size(), 2U);
  EXPECT_NEAR(open.sources[0].solid_angle, open.sources[1].solid_angle, 1e-12);

  // A screen at x = 3 that covers, from the eye, the lower half of the first lamp: to 1.2 + 1.45/2.
  room.add("screen", Vec3(3, 0.5, 0), Vec3(0, 1.2, 0), Vec3(0, 0, 1.925), 1, 1);
  room.grow();
  const Glare hidden = find_glare(observer, room.mesh, room.photometer());
  ASSERT_EQ(hidden.sources.size(), 2U);
  const auto corner = [](double y, double z) {
    return std::atan(y * z / (4 * std::sqrt(16 + y * y + z * z)));
  };
  const double upper = corner(-0.7, 1.6) - corner(-1, 1.6) - corner(-0.7, 1.45) + corner(-1, 1.45);
  EXPECT_NEAR(hidden.sources[0].solid_angle, upper, 1e-12);
  EXPECT_NEAR(hidden.sources[1].solid_angle, open.sources[1].solid_angle, 1e-12);
  EXPECT_LT(hidden.background, open.background);
}

TEST(Glare, IsNothingInDarknessAndBehind) {
  MeterRoom room;
  room.add("lamp", Vec3(-2, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 1, 1);
  room.shine("lamp", 1000, 10);
  const Observer observer{.name = "eye", .position = Vec3(1, 0, 0.5), .direction = Vec3::UnitX()};
  const Glare behind = find_glare(observer, room.mesh, room.photometer());
  EXPECT_TRUE(behind.sources.empty());
  EXPECT_EQ(behind.luminance, 0);
  Observer facing = observer;
  facing.direction = Vec3(-3, -0.5, 0).normalized();
  EXPECT_NEAR(find_glare(facing, room.mesh, room.photometer()).luminance, 1010 / kPi, 1e-9);
  EXPECT_FALSE(behind.ugr());
}

}  // namespace
}  // namespace radiosity
