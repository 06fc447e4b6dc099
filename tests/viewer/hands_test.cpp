// What a hand does with the scene: it holds a point, keeps views, measures.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "radiosity/scene/scene.h"
#include "viewer/desk/camera_control.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/saved_views.h"
#include "viewer/desk/tape.h"

namespace {

using radiosity::Vec3;

radiosity::Camera slanted_camera() {
  return {.position = Vec3(1, 2, 3), .direction = Vec3(-1, -2, -3).normalized(), .up = {0, 1, 0}};
}

// What is under the mouse stays there, whether one turns or goes towards it.
TEST(CameraControl, KeepsThePointThatIsHeldInItsPlace) {
  const radiosity::Box3 box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const Vec3 held(0.4, -0.3, 0.2);
  const auto place = [&](const radiosity::Camera& camera) {
    const Vec3 offset = held - camera.position;
    const Vec3 right = camera.direction.cross(camera.up).normalized();
    const double depth = offset.dot(camera.direction);
    return Eigen::Vector2d(offset.dot(right) / depth,
                           offset.dot(right.cross(camera.direction)) / depth);
  };
  viewer::CameraControl control(slanted_camera(), box);
  const Eigen::Vector2d before = place(control.camera());
  double distance = (control.camera().position - held).norm();
  for (int k = 0; k < 40; ++k) {
    control.orbit_about(held, 0.3, k < 20 ? 0.2 : -0.2);
    EXPECT_LE((place(control.camera()) - before).norm(), 1e-9);
    EXPECT_NEAR((control.camera().position - held).norm(), distance, 1e-9);
  }
  for (int k = 0; k < 100; ++k) {
    control.zoom_to(held, 0.8);
    EXPECT_LE((place(control.camera()) - before).norm(), 1e-6);
    EXPECT_LE((control.camera().position - held).norm(), distance);
    distance = (control.camera().position - held).norm();
  }
  EXPECT_GT(distance, 0);  // never through it
}

TEST(CameraControl, OrbitAboutThePivotIsOrbit) {
  const radiosity::Box3 box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  viewer::CameraControl one(slanted_camera(), box);
  viewer::CameraControl other(slanted_camera(), box);
  one.orbit(0.4, -0.2);
  other.orbit_about(other.pivot(), 0.4, -0.2);
  EXPECT_LE((one.camera().position - other.camera().position).norm(), 1e-12);
  EXPECT_LE((one.camera().direction - other.camera().direction).norm(), 1e-12);
}

TEST(Desk, TextIsNeverTooLargeOrTooSmall) {
  viewer::Desk desk;
  viewer::enlarge(desk, 1);
  EXPECT_EQ(desk.wanted_scale, 1.25);
  viewer::enlarge(desk, 1);
  EXPECT_EQ(desk.wanted_scale, 1.5);
  viewer::enlarge(desk, 100);
  EXPECT_EQ(desk.wanted_scale, 4);
  viewer::enlarge(desk, -100);
  EXPECT_EQ(desk.wanted_scale, 0.5);
}

TEST(SavedViews, AreFoundReplacedAndForgotten) {
  std::vector<viewer::SavedView> views;
  EXPECT_EQ(viewer::free_view_name(views), "view 1");
  viewer::save_view(views, "view 1", slanted_camera());
  viewer::save_view(views, "door", slanted_camera());
  radiosity::Camera other = slanted_camera();
  other.position = Vec3(7, 8, 9);
  viewer::save_view(views, "door", other);
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(viewer::view_named(views, "door").camera.position, other.position);
  EXPECT_EQ(viewer::free_view_name(views), "view 3");
  EXPECT_THROW(viewer::view_named(views, "window"), std::invalid_argument);
  EXPECT_THROW(viewer::save_view(views, "", other), std::invalid_argument);
  viewer::forget_view(views, "view 1");
  EXPECT_EQ(views.size(), 1U);
  EXPECT_THROW(viewer::forget_view(views, "view 1"), std::invalid_argument);
}

TEST(Tape, LiesBetweenTwoPoints) {
  viewer::Tape tape;
  viewer::lay(tape, Vec3(1, 0, 0));
  EXPECT_FALSE(tape.difference());
  viewer::lay(tape, Vec3(1, 3, 4));
  ASSERT_TRUE(tape.difference());
  EXPECT_EQ(tape.difference()->norm(), 5);
  viewer::lay(tape, Vec3(0, 0, 0));  // begins anew
  EXPECT_FALSE(tape.difference());
}

}  // namespace
