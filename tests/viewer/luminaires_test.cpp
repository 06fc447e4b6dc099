// Luminaires, sun and sky as lamps of an open scene, and how luminaires are shown.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "io/scene/scene_file.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/incident_light.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/lit_room.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/luminaire_shape.h"
#include "viewer/desk/luminaires.h"
#include "viewer/desk/measuring.h"

namespace radiosity::test {
namespace {

using viewer::Emitter;
using viewer::LightMix;
using viewer::LuminaireShape;

class Luminaires : public OutputFolder {};

/// The light of a scene by the library alone.
Solution solved(const Scene& scene, const viewer::Model& model) {
  const Conditions conditions = make_conditions(scene, *model.mesh, *model.transport,
                                                incident_irradiance(scene, *model.mesh));
  SolveOptions options = with_conditions({.tolerance = 1e-9, .estimates_errors = false}, conditions,
                                         scene.bands.count());
  return solve(*model.transport, conditions.exitance, conditions.reflectance, options);
}

void expect_same_light(const Solution& found, const Solution& expected) {
  EXPECT_LE((found.irradiance - expected.irradiance).norm(), 1e-6 * expected.irradiance.norm());
  EXPECT_LE((found.radiosity - expected.radiosity).norm(), 1e-6 * expected.radiosity.norm());
}

TEST_F(Luminaires, AreDimmedLikeLampsWhateverElseThereIs) {
  for (const LitRoom& room : lit_rooms()) {
    viewer::Session session({.patches = {.n_patches = 60}});
    open(session, room.write(folder()));
    const viewer::Model& model = session.model();
    std::vector<std::string> names;
    for (const Emitter& emitter : session.mix().emitters) names.push_back(emitter.name);
    std::vector<std::string> expected = {"lamp", "pendant", "spot"};
    if (room.has_daylight) expected.insert(expected.end(), {"sun", "sky"});
    EXPECT_EQ(names, expected);
    EXPECT_EQ(session.mix().emitters[1].scale, room.dimming);
    ASSERT_TRUE(session.light() != nullptr && session.light()->has_errors());
    expect_same_light(session.light()->solution, solved(*model.scene, model));
    ASSERT_TRUE(session.can_superpose());
    // Changes are on the screen at once, as a sum, and are what a solve would have found.
    for (std::size_t e = 0; e < names.size(); ++e) {
      session.set_emitter(e, 0.3 + 0.4 * static_cast<double>(e), e != 2);
      EXPECT_FALSE(session.is_change_pending());
    }
    const Solution summed = session.light()->solution;
    settle(session);
    const Solution expected_light = solved(viewer::mixed_scene(*model.scene, session.mix()), model);
    expect_same_light(summed, expected_light);
    expect_same_light(session.light()->solution, expected_light);
  }
}

// With other reflectances nothing is superposed; the direct light has to be that of the mix.
TEST_F(Luminaires, KeepTheirDimmingWhenMaterialsChange) {
  const LitRoom room = lit_rooms()[1];
  viewer::Session session({.patches = {.n_patches = 60}});
  open(session, room.write(folder()));
  session.set_emitter(2, 0.2, true);
  session.set_reflectance(0, Eigen::Vector3d(0.7, 0.2, 0.4));
  settle(session);
  const Scene mixed = viewer::mixed_scene(*session.model().scene, session.mix());
  EXPECT_EQ(mixed.luminaires[1].dimming, 0.2);
  expect_same_light(session.light()->solution, solved(mixed, session.model()));
}

TEST_F(Luminaires, ShareThePatchesLightWithAllOthers) {
  viewer::Desk desk({.patches = {.n_patches = 60}});
  open(desk.session, lit_rooms()[2].write(folder()));
  viewer::update(desk);
  desk.asks_light_path = true;
  desk.session.select(7);
  viewer::update(desk);
  settle(desk.session);
  viewer::update(desk);
  ASSERT_EQ(desk.emitter_shares.size(), 5U);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(3);
  for (const viewer::EmitterShare& share : desk.emitter_shares) {
    sum += share.radiosity;
    LightMix alone = desk.session.mix();
    for (std::size_t e = 0; e < alone.emitters.size(); ++e) {
      alone.emitters[e].is_on = e == share.emitter;
    }
    const Scene scene = viewer::mixed_scene(*desk.session.model().scene, alone);
    const Eigen::VectorXd expected = solved(scene, desk.session.model()).radiosity.row(7);
    EXPECT_LE((share.radiosity - expected).norm(), 1e-6 * desk.facts->radiosity.norm());
  }
  EXPECT_LE((sum - desk.facts->radiosity).norm(), 1e-6 * desk.facts->radiosity.norm());
  // Straight from emitters comes what is there before any patch reflects.
  const Scene mixed = viewer::mixed_scene(*desk.session.model().scene, desk.session.mix());
  const auto& mesh = *desk.session.model().mesh;
  const Eigen::MatrixXd straight = desk.session.model().transport->apply(exitance(mixed, mesh)) +
                                   incident_irradiance(mixed, mesh);
  EXPECT_LE((desk.facts->direct - straight.row(7).transpose()).norm(), 1e-9 * straight.norm());
  viewer::show(desk, "direct");
  const auto field = viewer::shown_field(desk.session.known(), desk.look);
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->values[7], straight.row(7).mean(), 1e-9 * straight.norm());
}

// In a black room E = I / d² straight below, as dimmed, whatever the patches are.
TEST_F(Luminaires, AreMeasuredAsDimmed) {
  LitRoom room = lit_rooms()[2];
  room.has_daylight = false;
  room.reflectance = 0;
  viewer::Desk desk({.patches = {.n_patches = 60}});
  open(desk.session, room.write(folder()));
  viewer::update(desk);                   // which forgets what was measured in the file before
  desk.session.set_emitter(0, 1, false);  // the lamp and the spot
  desk.session.set_emitter(2, 1, false);
  const Vec3 below = room.at(0.3, 0.4, 0);
  viewer::add_meter(desk, below, room.up());
  const double distance = (room.first() - below).norm();
  for (const double scale : {1.0, 0.25, 1.6}) {
    desk.session.set_emitter(1, scale, true);
    settle(desk.session);
    wait_until(desk.session, [&] {
      viewer::update(desk);
      return desk.meter.is_current(desk.session);
    });
    const double lux = scale * 800 / (distance * distance);
    EXPECT_NEAR(viewer::meter_value(desk, 0).value(), lux, 1e-9 * lux);
  }
}

TEST_F(Luminaires, AreTakenTogetherByFileWhereThereAreMany) {
  LitRoom room;
  Scene scene = io::read_scene(room.write(folder()));
  const Luminaire one = scene.luminaires.front();
  scene.luminaires.assign(60, one);
  for (std::size_t k = 0; k < 20; ++k) scene.luminaires[k].dimming = 0.5;
  const LightMix mix = viewer::make_mix(scene);
  ASSERT_EQ(mix.emitters.size(), 3U);
  EXPECT_EQ(mix.emitters[1].name, "spot.ies (50 %)");
  EXPECT_EQ(mix.emitters[1].luminaires.size(), 20U);
  EXPECT_EQ(mix.emitters[2].luminaires.size(), 40U);
  const Scene mixed = viewer::mixed_scene(scene, mix);
  for (std::size_t k = 0; k < 60; ++k) {
    EXPECT_EQ(mixed.luminaires[k].dimming, scene.luminaires[k].dimming);
  }
}

// A curve's points are as far from the luminaire as its intensity in their direction is of the
// peak.
TEST_F(Luminaires, HaveCurvesOfTheirIntensityWhereverTheyAim) {
  for (const LitRoom& room : lit_rooms()) {
    const Scene scene = io::read_scene(room.write(folder()));
    for (const Luminaire& luminaire : scene.luminaires) {
      const Photometry& photometry = scene.photometries[luminaire.photometry];
      const LuminaireShape shape =
          viewer::luminaire_shape(luminaire, photometry, 0.7, viewer::LuminaireDetail::solid);
      std::vector<LuminaireShape::Curve> curves = shape.solid;
      curves.insert(curves.end(), shape.planes.begin(), shape.planes.end());
      double farthest = 0;
      for (const LuminaireShape::Curve& curve : curves) {
        for (const Vec3& point : curve) {
          const Vec3 way = point - luminaire.position;
          const double length = way.norm();
          farthest = std::max(farthest, length);
          if (length < 1e-9) continue;
          const double candela = intensity(photometry.web, luminaire.axes.transpose() * way);
          EXPECT_NEAR(length, 0.7 * candela / 800, 1e-9);
        }
      }
      EXPECT_NEAR(farthest, 0.7, 1e-12);
      ASSERT_EQ(shape.opening.size(), 5U);  // 0.6 m along C0, as IES has it
      EXPECT_NEAR((shape.opening[0] - shape.opening[1]).norm(), photometry.along_c0, 1e-12);
      EXPECT_NEAR((shape.opening[1] - shape.opening[2]).norm(), photometry.along_c90, 1e-12);
      EXPECT_NEAR((shape.aim[1] - shape.aim[0]).norm(), 0.7, 1e-12);
    }
    const Vec3 aim = room.at(0.2, 0.3, 0) - room.second();
    const LuminaireShape spot = viewer::luminaire_shape(
        scene.luminaires[1], scene.photometries.front(), 1, viewer::LuminaireDetail::curves);
    EXPECT_LE((spot.aim[1] - spot.aim[0]).cross(aim).norm(), 1e-9 * aim.norm());
    EXPECT_TRUE(spot.solid.empty());
  }
}

TEST_F(Luminaires, AreFoundInThePictureUnlessSomethingHidesThem) {
  LitRoom room;
  viewer::Desk desk({.patches = {.n_patches = 60}});
  open(desk.session, room.write(folder()));
  viewer::update(desk);
  ASSERT_EQ(desk.luminaires.size(), 2U);
  desk.region = {.width = 400, .height = 300};
  Camera camera;
  camera.position = room.at(0.95, 0.9, 0.4);
  camera.direction = (room.first() - camera.position).normalized();
  camera.up = room.up();
  desk.camera = viewer::CameraControl(camera, desk.session.model().bounds);
  EXPECT_EQ(viewer::luminaire_at(desk, 0.5, 0.5), 0U);
  EXPECT_FALSE(viewer::luminaire_at(desk, 0.1, 0.9));
  const auto place = viewer::picture_place(desk, room.second());
  ASSERT_TRUE(place);
  EXPECT_EQ(viewer::luminaire_at(desk, place->x(), place->y()), 1U);
  desk.hovered_luminaire = 1;
  EXPECT_EQ(viewer::hovered_text(desk), "spot: 900 lm, spot.ies");
  desk.session.set_emitter(2, 0.5, true);
  EXPECT_EQ(viewer::hovered_text(desk), "spot: 900 lm, dimmed to 450 lm, spot.ies");
  desk.session.set_emitter(2, 0.5, false);
  EXPECT_EQ(viewer::hovered_text(desk), "spot: 900 lm, off, spot.ies");
  // From below the floor, which hides it with its back unless backs are looked through.
  camera.position = room.at(0.3, 0.4, 3);
  camera.direction = -room.up();
  camera.up = room.turn.col(1);
  desk.camera = viewer::CameraControl(camera, desk.session.model().bounds);
  EXPECT_TRUE(viewer::luminaire_at(desk, 0.5, 0.5));  // through the back of the ceiling
  desk.look.luminaires = false;
  EXPECT_FALSE(viewer::luminaire_at(desk, 0.5, 0.5));
  viewer::choose_luminaire(desk, 1);
  EXPECT_THROW(viewer::choose_luminaire(desk, 2), std::out_of_range);
  EXPECT_EQ(viewer::emitter_lumens(desk, 1), desk.luminaires[0].lumens);
  EXPECT_FALSE(viewer::emitter_lumens(desk, 0));
}

}  // namespace
}  // namespace radiosity::test
