#include "radiosity/picture/camera_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "radiosity/picture/render.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::Facing;

PatchMesh seen_room() {
  PatchMesh mesh;
  test::add_box(mesh, Vec3::Zero(), Vec3(4, 3, 5), 3, Facing::inwards);
  return mesh;
}

ViewContent content(const PatchMesh& mesh, const Vec3& position, const Vec3& direction,
                    double fov = 0.7) {
  const Vec3 up = std::abs(direction.y()) > 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  return view_content(mesh, {position, direction.normalized(), up, fov}, 1.5);
}

TEST(ViewContent, TellsFrontsFromBacks) {
  const PatchMesh mesh = seen_room();
  const auto inside = content(mesh, Vec3(2, 1, 1), Vec3(0.2, 0.1, 1));
  EXPECT_TRUE(inside.fronts);
  EXPECT_FALSE(inside.backs);
  const auto outside = content(mesh, Vec3(2, 1, -5), Vec3::UnitZ());
  EXPECT_TRUE(outside.fronts);  // of the far wall
  EXPECT_TRUE(outside.backs);
  const auto away = content(mesh, Vec3(2, 1, -5), -Vec3::UnitZ());
  EXPECT_FALSE(away.fronts);
  EXPECT_FALSE(away.backs);
  PatchMesh solid;
  test::add_box(solid, Vec3::Zero(), Vec3(4, 3, 5), 3, Facing::outwards);
  const auto in_solid = content(solid, Vec3(2, 1, 1), Vec3(0.2, 0.1, 1));
  EXPECT_FALSE(in_solid.fronts);
  EXPECT_TRUE(in_solid.backs);
}

TEST(ViewContent, EndsAtTheBordersOfThePicture) {
  PatchMesh square;  // 1 x 1 m at distance 10 m, its near edge 5 m to the right
  test::add_grid(square, Vec3(5, -0.5, -10), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  for (const double width : {4.99, 5.01}) {  // half the picture's width on the plane
    const double fov = 2 * std::atan(width / 10 / 1.5);
    EXPECT_EQ(content(square, Vec3::Zero(), -Vec3::UnitZ(), fov).fronts, width > 5) << width;
  }
}

/// Whether any ray of a picture of that size meets an emitting side.
bool is_shown(const PatchMesh& mesh, const Visibility& visibility, const Camera& camera,
              int height) {
  const Image image = render(mesh, visibility, Eigen::MatrixXd::Ones(mesh.size(), 1), camera,
                             {.width = height * 3 / 2, .height = height, .samples = 1});
  return std::any_of(image.alpha.begin(), image.alpha.end(), [](float alpha) { return alpha > 0; });
}

// What the exact test says agrees with the picture itself, from wherever one looks; slivers at the
// border need many pixels.
TEST(ViewContent, AgreesWithThePicture) {
  PatchMesh mesh;
  test::add_grid(mesh, Vec3(0, 0, 0), Vec3::UnitX(), Vec3::UnitY(), 2, 2);
  test::add_box(mesh, Vec3(2, 0, 0), Vec3(3, 1, 1), 1, Facing::outwards);
  const Visibility visibility(mesh);
  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int n_empty = 0;
  for (int k = 0; k < 300; ++k) {
    const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    const Vec3 position = 3 * point();
    const Camera camera = {position, point().normalized(), Vec3::UnitY(), 1.4};
    const bool expected = view_content(mesh, camera, 1.5).fronts;
    bool shown = is_shown(mesh, visibility, camera, 64);
    if (expected && !shown) shown = is_shown(mesh, visibility, camera, 1024);
    EXPECT_EQ(expected, shown) << "camera " << k << " of seed 20";
    n_empty += shown ? 0 : 1;
  }
  EXPECT_GT(n_empty, 50);
  EXPECT_LT(n_empty, 250);
}

TEST(Surroundings, AreBacksInsideASolidOrAWall) {
  PatchMesh mesh = seen_room();
  test::add_box(mesh, Vec3(1, 0.1, 1), Vec3(2, 1, 2), 2, Facing::outwards);
  test::add_box(mesh, Vec3(-0.4, -0.4, -0.4), Vec3(4.4, 3.4, 5.4), 2, Facing::outwards);
  const Visibility visibility(mesh);
  const Surroundings in_box = surroundings(visibility, Vec3(1.5, 0.2, 1.4));
  EXPECT_EQ(in_box.backs, 1);
  EXPECT_EQ(mesh.normal[in_box.nearest], -Vec3::UnitY());
  EXPECT_EQ(surroundings(visibility, Vec3(2, 1, -0.2)).backs, 1);  // in the room's wall
  EXPECT_EQ(surroundings(visibility, Vec3(3, 2, 3)).backs, 0);     // in the room
  EXPECT_EQ(surroundings(visibility, Vec3(3, 2, 9)).backs, 0);     // outside all
}

TEST(Surroundings, AreHalfBacksJustOutsideARoom) {
  const PatchMesh mesh = seen_room();
  const Visibility visibility(mesh);
  const double share = surroundings(visibility, Vec3(2, 1.5, -1e-3)).backs;
  EXPECT_GT(share, 0.49);
  EXPECT_LT(share, 0.51);
}

}  // namespace
}  // namespace radiosity
