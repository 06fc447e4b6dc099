// Surfaces that are made lamps.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/incident_light.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/lit_room.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/desk_surfaces.h"
#include "viewer/desk/painting.h"
#include "viewer/desk/picture_words.h"
#include "viewer/work/lamp.h"
#include "viewer/work/standing.h"

namespace radiosity::test {
namespace {

/// Lumens that a surface emits by itself.
double emitted_lumens(const viewer::Session& session, std::int32_t surface) {
  const PatchMesh& mesh = *session.model().mesh;
  const Eigen::VectorXd exitance =
      session.light()->solution.exitance * luminous_weights(session.model().bands);
  double sum = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] == surface) sum += mesh.area[i] * exitance[i];
  }
  return sum;
}

/// The first surface that emits nothing.
std::int32_t dark_surface(const viewer::Session& session) {
  const Scene& scene = *session.model().scene;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Emission& emission = scene.materials[scene.surfaces[s].material].emission;
    if (emission.kind == Emission::Kind::none) return static_cast<std::int32_t>(s);
  }
  return -1;
}

// Grey, RGB and spectral: the surface gives what was asked, and the light is that of the new scene.
TEST(Lamps, GiveTheirLumensWhateverTheBands) {
  for (const char* name : {"lit-office", "cornell-box", "cornell-box-spectral"}) {
    SCOPED_TRACE(name);
    viewer::Session session({.patches = {.n_patches = 60}});
    open(session, std::string(RADIOSITY_SCENES) + "/" + name + ".json");
    const std::size_t n_before = session.mix().emitters.size();
    session.set_emitter(0, 0.25, true);
    const std::int32_t dark = dark_surface(session);
    session.make_lamp(dark, 1234);
    settle(session);
    ASSERT_TRUE(session.light() != nullptr && session.light()->has_errors());
    EXPECT_TRUE(session.has_result());
    EXPECT_NEAR(emitted_lumens(session, dark), 1234, 1e-9 * 1234);
    ASSERT_EQ(session.mix().emitters.size(), n_before + 1);
    double scales = 0;
    for (const viewer::Emitter& emitter : session.mix().emitters) scales += emitter.scale;
    EXPECT_EQ(scales, 0.25 + static_cast<double>(n_before));  // the others stay
    const Scene scene = viewer::mixed_scene(*session.model().scene, session.mix());
    const PatchMesh& mesh = *session.model().mesh;
    const Solution expected =
        solve(*session.model().transport, exitance(scene, mesh), reflectance(scene, mesh),
              {.tolerance = 1e-9, .estimates_errors = false});
    EXPECT_LE((session.light()->solution.radiosity - expected.radiosity).norm(),
              1e-6 * expected.radiosity.norm());
    // Again, with other lumens.
    session.make_lamp(dark, 10);
    settle(session);
    EXPECT_NEAR(emitted_lumens(session, dark), 10, 1e-9 * 10);
    // A lamp that was dimmed gives what is asked of it, too.
    const std::int32_t lamp = session.mix().emitters[dark == 0 ? 1 : 0].surfaces.front();
    session.make_lamp(lamp, 77);
    settle(session);
    EXPECT_NEAR(emitted_lumens(session, lamp), 77, 1e-9 * 77);
    EXPECT_EQ(session.mix().emitters.size(), n_before + 1);
  }
}

class LampsBeside : public OutputFolder {};

bool is_painted_as_light(const viewer::Desk& desk) {
  return viewer::make_painting({.known = desk.session.known(), .look = desk.look, .up = desk.up})
      .is_light;
}

// Where nothing gives light there is more to see than black, and the picture says what to do; lamps
// that are only switched off are another thing.
TEST_F(LampsBeside, AreAskedForWhereThereAreNone) {
  const std::string room = (folder() / "room.obj").string();
  std::ofstream(room) << "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 0 1 1\n"
                         "o floor\nf 1 2 3 4\no ceiling\nf 5 8 7 6\no walls\nf 1 5 6 2\n"
                         "f 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
  viewer::Desk desk({.patches = {.n_patches = 60}});
  desk.session.open(room);
  wait_until(desk.session, [&] { return desk.session.is_open(); });
  EXPECT_NE(viewer::picture_words(desk).message.find("make it a lamp"), std::string::npos);
  settle(desk.session);
  viewer::update(desk);
  ASSERT_EQ(desk.session.light()->kind, viewer::Light::Kind::complete);
  EXPECT_NE(viewer::picture_words(desk).message.find("make it a lamp"), std::string::npos);
  EXPECT_EQ(viewer::standing(desk.session).text.find("solved"), std::string::npos);
  EXPECT_FALSE(is_painted_as_light(desk));
  // Of which one, a name in the list tells, too: from outside no ceiling can be clicked.
  EXPECT_EQ(viewer::meant_surface(desk), std::nullopt);
  desk.session.select(0);
  viewer::update(desk);
  EXPECT_EQ(viewer::meant_surface(desk), 0);
  viewer::mark_surfaces(desk, std::vector<std::int32_t>{1});
  EXPECT_EQ(viewer::meant_surface(desk), 1);
  desk.is_exposure_due = false;
  viewer::make_lamp(desk, 1, 500);
  EXPECT_TRUE(desk.is_exposure_due);  // what suits other lamps may show white alone
  settle(desk.session);
  viewer::update(desk);
  EXPECT_EQ(viewer::picture_words(desk).message, "");
  EXPECT_TRUE(is_painted_as_light(desk));
  desk.session.set_emitter(0, 1, false);
  settle(desk.session);
  viewer::update(desk);
  EXPECT_EQ(viewer::picture_words(desk).message, "");
  EXPECT_TRUE(is_painted_as_light(desk));
}

TEST_F(LampsBeside, LuminairesAndDaylightLeaveThoseAsTheyAre) {
  viewer::Desk desk({.patches = {.n_patches = 40}});
  open(desk.session, lit_rooms()[1].write(folder()));
  viewer::update(desk);
  desk.session.set_emitter(2, 0.5, true);  // the spot
  desk.session.make_lamp(1, 500);
  settle(desk.session);
  viewer::update(desk);
  std::vector<std::string> names;
  for (const viewer::Emitter& emitter : desk.session.mix().emitters) names.push_back(emitter.name);
  EXPECT_EQ(names, (std::vector<std::string>{"ceiling", "lamp", "pendant", "spot", "sun", "sky"}));
  EXPECT_EQ(desk.session.mix().emitters[3].scale, 0.5);
  EXPECT_EQ(desk.luminaires.at(1).emitter, 3U);
  const Scene mixed = viewer::mixed_scene(*desk.session.model().scene, desk.session.mix());
  const PatchMesh& mesh = *desk.session.model().mesh;
  SolveOptions options = {.tolerance = 1e-9, .estimates_errors = false};
  options.incident = incident_irradiance(mixed, mesh);
  const Solution expected = solve(*desk.session.model().transport, exitance(mixed, mesh),
                                  reflectance(mixed, mesh), options);
  EXPECT_LE((desk.session.light()->solution.radiosity - expected.radiosity).norm(),
            1e-6 * expected.radiosity.norm());
}

TEST(Lamps, AreRefusedWhereTheyCannotBe) {
  viewer::Session session({.patches = {.n_patches = 60}});
  EXPECT_THROW(session.make_lamp(0, 1), SceneError);
  open(session, kBox);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double lumens : {0.0, -5.0, std::nan(""), infinite}) {
    EXPECT_THROW(session.make_lamp(0, lumens), std::out_of_range) << lumens;
  }
  EXPECT_THROW(session.make_lamp(-1, 1), std::out_of_range);
  EXPECT_THROW(session.make_lamp(1000, 1), std::out_of_range);
  EXPECT_TRUE(session.has_result());  // all is as it was
  EXPECT_THROW(viewer::with_lamp(io::read_scene(kThermal), 0, 1), SceneError);
}

}  // namespace
}  // namespace radiosity::test
