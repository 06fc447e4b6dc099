// The sun and the sky of an open scene, moved and changed.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/incident_light.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/lit_room.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/daylight.h"
#include "viewer/desk/desk.h"

namespace radiosity::test {
namespace {

class Daylight : public OutputFolder {};

/// The light of the desk's mix by the library alone.
void expect_light_of_mix(const viewer::Desk& desk) {
  const viewer::Model& model = desk.session.model();
  const Scene scene = viewer::mixed_scene(*model.scene, desk.session.mix());
  const Conditions conditions = make_conditions(scene, *model.mesh, *model.transport,
                                                incident_irradiance(scene, *model.mesh));
  const SolveOptions options = with_conditions({.tolerance = 1e-9, .estimates_errors = false},
                                               conditions, scene.bands.count());
  const Solution expected =
      solve(*model.transport, conditions.exitance, conditions.reflectance, options);
  const Solution& found = desk.session.light()->solution;
  EXPECT_LE((found.irradiance - expected.irradiance).norm(), 1e-6 * expected.irradiance.norm());
}

TEST_F(Daylight, FollowsTheSunWhereverItIsPut) {
  for (const LitRoom& room : {lit_rooms()[1], lit_rooms()[2]}) {
    viewer::Desk desk({.patches = {.n_patches = 24}});
    open(desk.session, room.write(folder()));
    viewer::update(desk);
    const auto before = viewer::sun_place(desk);
    ASSERT_TRUE(before);
    EXPECT_NEAR(std::sin(before->elevation), room.up().dot(-desk.session.mix().sun->direction),
                1e-12);
    const double outdoors = viewer::sky_illuminance(desk).value();
    EXPECT_NEAR(outdoors, 8000, 1e-3 * 8000);
    viewer::set_sky_type(desk, 3);  // brighter towards the sun
    const viewer::SunPlace place = {.azimuth = 3.9, .elevation = 0.8};
    viewer::set_sun_place(desk, place);
    const auto now = viewer::sun_place(desk);
    EXPECT_NEAR(now->azimuth, place.azimuth, 1e-12);
    EXPECT_NEAR(now->elevation, place.elevation, 1e-12);
    EXPECT_LE((desk.session.mix().sky->towards_sun + desk.session.mix().sun->direction).norm(),
              1e-12);
    EXPECT_NEAR(viewer::sky_illuminance(desk).value(), outdoors, 1e-6 * outdoors);
    settle(desk.session);
    expect_light_of_mix(desk);
    // Dimmed by half, and not at all, where it stands now.
    ASSERT_TRUE(desk.session.can_superpose());
    desk.session.set_emitter(3, 0.5, true);
    expect_light_of_mix(desk);
    for (int k = 0; k < 3; ++k) desk.session.undo_mix();
    EXPECT_NEAR(viewer::sun_place(desk)->azimuth, before->azimuth, 1e-12);
    settle(desk.session);
    expect_light_of_mix(desk);
  }
}

TEST_F(Daylight, KeepsItsIlluminanceUnderOtherSkies) {
  viewer::Desk desk({.patches = {.n_patches = 24}});
  open(desk.session, lit_rooms()[2].write(folder()));
  viewer::update(desk);
  EXPECT_EQ(viewer::sky_type(desk), 5);
  const double outdoors = viewer::sky_illuminance(desk).value();
  for (const int type : {1, 4, 12, 16}) {
    viewer::set_sky_type(desk, type);
    EXPECT_EQ(viewer::sky_type(desk), type);
    EXPECT_NEAR(viewer::sky_illuminance(desk).value(), outdoors, 1e-6 * outdoors);
    EXPECT_EQ(viewer::sky_type_name(type)[0], type == 4 ? '4' : '1');
  }
  settle(desk.session);
  expect_light_of_mix(desk);
  EXPECT_THROW(viewer::set_sky_type(desk, 17), SceneError);
  // A saved scene has the sky as it is now.
  const auto path = (folder() / "saved.json").string();
  viewer::save_scene(desk, path);
  viewer::Desk other({.patches = {.n_patches = 24}});
  open(other.session, path);
  viewer::update(other);
  EXPECT_EQ(viewer::sky_type(other), 16);
  EXPECT_NEAR(viewer::sky_illuminance(other).value(), outdoors, 1e-6 * outdoors);
  desk.session.reset_daylight();
  EXPECT_EQ(viewer::sky_type(desk), 5);
}

TEST_F(Daylight, StandsWherePlaceAndTimeSay) {
  viewer::Desk desk({.patches = {.n_patches = 24}});
  open(desk.session, lit_rooms()[1].write(folder()));
  viewer::update(desk);
  const PlaceAndTime noon = {.latitude = 0.84, .longitude = 0, .month = 6, .day = 21, .hour = 12};
  viewer::set_sun_time(desk, noon);
  const SolarPosition expected = solar_position(noon);
  EXPECT_NEAR(viewer::sun_place(desk)->azimuth, expected.azimuth, 1e-12);
  EXPECT_NEAR(viewer::sun_place(desk)->elevation, expected.elevation, 1e-12);
  PlaceAndTime night = noon;
  night.hour = 0;
  EXPECT_THROW(viewer::set_sun_time(desk, night), std::out_of_range);
  EXPECT_NEAR(viewer::sun_place(desk)->azimuth, expected.azimuth, 1e-12);  // it stays
  settle(desk.session);
  open(desk.session, kRoom);
  viewer::update(desk);
  EXPECT_FALSE(viewer::sun_place(desk));
  EXPECT_THROW(viewer::set_sun_place(desk, {.elevation = 1}), SceneError);
  EXPECT_THROW(viewer::set_sky_type(desk, 1), SceneError);
}

}  // namespace
}  // namespace radiosity::test
