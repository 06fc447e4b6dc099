// The scene's grids and observers, measured and shown without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/scene/scene_file.h"
#include "radiosity/solve/quantity.h"
#include "study/daylight.h"
#include "study/measured_plan.h"
#include "study/requirement_check.h"
#include "study/study.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/lit_room.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/grids.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/plane_picture.h"
#include "viewer/desk/shown_scale.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using study::LampAge;

const study::StudyOptions kFew = {.patches = {.n_patches = 60}};

/// Grids of each kind and an observer.
json plan(const LitRoom& room) {
  return {{"maintenance_factor", 0.8},
          {"grids",
           {{{"name", "floor"},
             {"surface", "floor"},
             {"offset", 0.5},
             {"cylindrical", true},
             {"up", numbers(room.up())},
             {"required", {{"Em", 1}, {"U0", 0.999}, {"UGR", 90}}}},
            {{"name", "part"},
             {"corner", numbers(room.at(0.2, 0.2, 0.3))},
             {"sides",
              {numbers(room.at(0.6, 0.2, 0.3) - room.at(0.2, 0.2, 0.3)),
               numbers(room.at(0.2, 0.7, 0.3) - room.at(0.2, 0.2, 0.3))}},
             {"up", numbers(room.up())},
             {"required", {{"Em", 1e6}, {"Ud", 0.01}}}}}},
          {"observers",
           {{{"name", "eye"},
             {"position", numbers(room.at(0.9, 0.9, 0.5))},
             {"direction", numbers((room.at(0.1, 0.1, 0.6) - room.at(0.9, 0.9, 0.5)).normalized())},
             {"up", numbers(room.up())},
             {"UGR", 10}}}}};
}

class Grids : public OutputFolder {
 protected:
  /// Opens a scene and waits until its plan is measured.
  static void open_measured(viewer::Desk& desk, const std::filesystem::path& path) {
    open(desk.session, path);
    wait_measured(desk);
  }
  static void wait_measured(viewer::Desk& desk) {
    viewer::update(desk);
    wait_until(desk.session, [&] {
      viewer::update(desk);
      return desk.session.is_idle() && desk.plan.is_current(desk.session);
    });
  }
};

/// Both solve to the iteration's tolerance, from different beginnings.
void expect_same_plan(const study::MeasuredPlan& found, const study::MeasuredPlan& expected) {
  const double tolerance = 10 * study::iteration_tolerance(kFew.tolerance);
  ASSERT_EQ(found.grids.size(), expected.grids.size());
  EXPECT_EQ(found.has_maintenance, expected.has_maintenance);
  for (std::size_t g = 0; g < found.grids.size(); ++g) {
    const auto& mine = found.grids[g].light;
    const auto& theirs = expected.grids[g].light;
    EXPECT_EQ(mine.places, theirs.places);
    ASSERT_EQ(mine.quantities.size(), theirs.quantities.size());
    for (std::size_t q = 0; q < mine.quantities.size(); ++q) {
      EXPECT_EQ(mine.quantities[q].name, theirs.quantities[q].name);
      for (const LampAge age : {LampAge::new_lamps, LampAge::maintained}) {
        const Eigen::VectorXd expected_lux = theirs.quantities[q].total(expected.light(age));
        EXPECT_LE((mine.quantities[q].total(found.light(age)) - expected_lux).norm(),
                  tolerance * expected_lux.norm());
      }
    }
  }
  ASSERT_EQ(found.observers.size(), expected.observers.size());
  for (std::size_t k = 0; k < found.observers.size(); ++k) {
    ASSERT_TRUE(found.observers[k].glare.ugr() && expected.observers[k].glare.ugr());
    EXPECT_NEAR(*found.observers[k].glare.ugr(), *expected.observers[k].glare.ugr(), 1e-4);
  }
}

TEST_F(Grids, AreMeasuredAsRadiosityLightDoes) {
  for (LitRoom room : {lit_rooms()[0], lit_rooms()[2]}) {
    room.has_daylight = false;
    room.more = plan(room);
    const auto path = room.write(folder());
    viewer::Desk desk(kFew);
    open_measured(desk, path);
    const study::Study solved = study::run(io::read_scene(path), kFew);
    const auto expected = study::measure_plan(solved, solved.scene.light_plan, kFew);
    expect_same_plan(desk.plan.readings()->measured, expected);
    // As dimmed, once the light is known.
    desk.session.set_emitter(1, 0.3, true);
    EXPECT_FALSE(desk.plan.is_current(desk.session));
    wait_measured(desk);
    Scene dimmed = io::read_scene(path);
    dimmed.luminaires[0].dimming = 0.3;
    const study::Study again = study::run(dimmed, kFew);
    expect_same_plan(desk.plan.readings()->measured,
                     study::measure_plan(again, dimmed.light_plan, kFew));
  }
}

TEST_F(Grids, TellInWordsWhatIsRequiredAndMet) {
  LitRoom room;
  room.more = plan(room);
  viewer::Desk desk(kFew);
  open_measured(desk, room.write(folder()));
  EXPECT_EQ(viewer::grids_note(desk), "");
  EXPECT_EQ(viewer::requirement_text(desk), "3 of 6 required values met");
  EXPECT_FALSE(viewer::are_requirements_met(desk));
  const auto maintained = viewer::grid_lines(desk, {.grid = 0, .is_maintained = true});
  ASSERT_EQ(maintained.size(), 7U);
  EXPECT_EQ(maintained[0].what, "Em");
  EXPECT_EQ(maintained[0].required, "≥ 1");
  EXPECT_EQ(maintained[0].is_met, true);
  EXPECT_EQ(maintained[3].what, "U0");
  EXPECT_EQ(maintained[3].is_met, false);
  EXPECT_EQ(maintained[5].what, "UGR");
  // Nothing is required of new lamps, nor of other quantities.
  for (const viewer::GridChoice& choice :
       {viewer::GridChoice{.grid = 0}, {.grid = 0, .quantity = 1, .is_maintained = true}}) {
    for (const auto& line : viewer::grid_lines(desk, choice)) EXPECT_FALSE(line.is_met);
  }
  const auto observers = viewer::observer_lines(desk);
  ASSERT_EQ(observers.size(), 1U);
  EXPECT_EQ(observers[0].what, "eye");
  EXPECT_EQ(observers[0].required, "≤ 10");
  EXPECT_EQ(viewer::grid_quantities(desk, 0),
            (std::vector<std::string>{"illuminance", "cylindrical"}));
}

TEST_F(Grids, AreShownWithTheirValuesUnderTheMouse) {
  LitRoom room;
  room.more = plan(room);
  viewer::Desk desk(kFew);
  open_measured(desk, room.write(folder()));
  EXPECT_FALSE(viewer::shown_grid(desk));
  viewer::show_grid(desk, {.grid = 1, .is_maintained = true});
  EXPECT_EQ(viewer::show_name(desk.look), "grid");
  EXPECT_TRUE(desk.look.isolines);
  const auto shown = viewer::shown_grid(desk);
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->title, "part: illuminance, maintained");
  const auto picture =
      viewer::plane_picture(shown->measured, shown->values, {.unit = "lux"}, desk.look);
  EXPECT_EQ(picture.legend.greatest, shown->values.maxCoeff());
  // From above, through the back of the ceiling, at each point in turn.
  desk.region = {.width = 400, .height = 300};
  for (Index k = 0; k < shown->values.size(); k += 7) {
    const Vec3 point = shown->points[static_cast<std::size_t>(k)];
    Camera camera;
    camera.position = point + 4 * room.up();
    camera.direction = -room.up();
    camera.up = room.turn.col(1);
    desk.camera = viewer::CameraControl(camera, desk.session.model().bounds);
    EXPECT_EQ(viewer::plane_value_at(desk, 0.5, 0.5), shown->values[k]);
  }
  EXPECT_THROW(viewer::show_grid(desk, {.grid = 2}), std::out_of_range);
  EXPECT_THROW(viewer::show_grid(desk, {.grid = 1, .quantity = 1}), std::out_of_range);
  // Other scenes have none.
  open(desk.session, kRoom);
  viewer::update(desk);
  EXPECT_NE(viewer::show_name(desk.look), "grid");
  EXPECT_FALSE(viewer::has_light_plan(desk.session));
  EXPECT_TRUE(viewer::grid_lines(desk, {}).empty());
}

// Whatever lamps, sun and the sky's strength are, and of each grid.
TEST_F(Grids, HaveDaylightFactorsBelowASky) {
  for (LitRoom room : {lit_rooms()[1], lit_rooms()[2]}) {
    room.has_daylight = true;
    room.more = plan(room);
    const auto path = room.write(folder());
    const study::Study by_day = study::run(study::daylight_scene(io::read_scene(path)), kFew);
    const Eigen::VectorXd weights = luminous_weights(by_day.scene.bands);
    viewer::Desk desk(kFew);
    open_measured(desk, path);
    ASSERT_EQ(desk.session.mix().emitters.back().kind, viewer::Emitter::Kind::sky);
    for (const double scale : {1.0, 0.2, 0.0}) {
      desk.session.set_emitter(desk.session.mix().emitters.size() - 1, scale, scale > 0);
      wait_measured(desk);
      for (std::size_t g = 0; g < 2; ++g) {
        const auto& grid = desk.plan.readings()->measured.grids[g];
        const std::size_t last = grid.light.quantities.size() - 1;
        EXPECT_EQ(viewer::grid_quantities(desk, g).at(last), "daylight factor");
        viewer::show_grid(desk, {.grid = g, .quantity = last});
        const auto shown = viewer::shown_grid(desk);
        ASSERT_TRUE(shown);
        EXPECT_EQ(shown->unit, "%");
        std::vector<study::DaylightPoint> points;
        for (std::size_t k = 0; k < shown->points.size(); ++k) {
          points.push_back({shown->points[k], grid.light.where.normals[k]});
        }
        const auto expected = study::daylight_factors(by_day, points, {}, weights);
        double largest = 0;
        for (const auto& factor : expected) largest = std::max(largest, 100 * factor.total());
        ASSERT_GT(largest, 0);
        for (std::size_t k = 0; k < points.size(); ++k) {
          if (shown->measured.places[k] != PointPlace::open) continue;
          EXPECT_NEAR(shown->values[static_cast<Index>(k)], 100 * expected[k].total(),
                      1e-3 * largest);
        }
        EXPECT_EQ(viewer::grid_lines(desk, desk.look.grid)[0].what, "mean");
      }
    }
  }
}

TEST(LegendTicks, AreMultiplesOfTheStepThatIsGiven) {
  viewer::Look look;
  const io::ColorScale scale = {.low = 40, .high = 260};
  look.tick_spacing = 50;
  EXPECT_EQ(viewer::legend_ticks(look, scale, 11), (std::vector<double>{50, 100, 150, 200, 250}));
  look.tick_spacing = 20;
  EXPECT_EQ(viewer::legend_ticks(look, scale, 3).size(), 12U);  // both ends
  const std::vector<double> automatic = viewer::legend_ticks({}, scale, 11);
  EXPECT_LE(automatic.size(), 11U);
  look.tick_spacing = 0.01;  // hundreds
  EXPECT_EQ(viewer::legend_ticks(look, scale, 11), automatic);
  look.tick_spacing = 50;
  io::ColorScale logarithmic = {.low = 1, .high = 1000, .logarithmic = true};
  EXPECT_EQ(viewer::legend_ticks(look, logarithmic, 11), viewer::legend_ticks({}, logarithmic, 11));
}

}  // namespace
}  // namespace radiosity::test
