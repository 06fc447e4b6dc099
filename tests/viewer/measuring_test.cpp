// Light on a work plane and at single points, without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/solve/quantity.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/plane_picture.h"

namespace {

using radiosity::Index;
using radiosity::MeasuredGrid;
using radiosity::PointPlace;
using radiosity::Vec3;
using namespace radiosity::test;
namespace fs = std::filesystem;

/// 6 x 4 points a metre apart, at height 1, of which one is in a solid.
MeasuredGrid small_grid() {
  MeasuredGrid measured;
  measured.grid = {.corner = Vec3(0, 0, 1),
                   .column = Vec3::UnitX(),
                   .row = Vec3::UnitY(),
                   .n_columns = 6,
                   .n_rows = 4};
  measured.places.assign(24, PointPlace::open);
  measured.places[9] = PointPlace::inside;
  measured.irradiance = Eigen::MatrixXd::Zero(24, 1);
  return measured;
}

/// 100 lux more for each metre in x.
Eigen::VectorXd ramp(const MeasuredGrid& measured) {
  return Eigen::VectorXd::NullaryExpr(measured.grid.size(),
                                      [&](Index k) { return 100 * measured.grid.point(k).x(); });
}

TEST(PlanePicture, HasACellForEachPointThatIsMeasured) {
  const MeasuredGrid measured = small_grid();
  for (const bool is_smooth : {true, false}) {
    const viewer::PlanePicture picture =
        viewer::plane_picture(measured, ramp(measured), {.unit = "lux", .note = "old"},
                              {.show = viewer::Show::work_plane, .smooth = is_smooth});
    EXPECT_EQ(picture.triangles.size(), 4 * 23U);
    ASSERT_EQ(picture.points.size(), picture.positions.size());
    for (std::size_t k = 0; k < picture.points.size(); ++k) {
      const Vec3& point = picture.points[k];
      EXPECT_EQ(point.z(), 1);
      EXPECT_FALSE((point - measured.grid.point(9)).norm() < 0.1);
    }
    EXPECT_EQ(picture.legend.least, 50);
    EXPECT_EQ(picture.legend.greatest, 550);
    EXPECT_EQ(picture.legend.title.back(), "old");
    EXPECT_EQ(picture.legend.fit, "0 to 98 % of points");
  }
}

// On a ramp lines of equal value are straight: at x = value / 100, but for cells at the border and
// beside the hole, whose corners have fewer neighbours to be the mean of.
TEST(PlanePicture, HasIsolinesWhereTheValuesAre) {
  const MeasuredGrid measured = small_grid();
  viewer::Look look = {.show = viewer::Show::work_plane, .isolines = true};
  look.range = io::ColorScale{.low = 0, .high = 600};
  const viewer::PlanePicture picture =
      viewer::plane_picture(measured, ramp(measured), {.unit = "lux"}, look);
  ASSERT_FALSE(picture.lines.empty());
  ASSERT_FALSE(picture.numbers.empty());
  for (const viewer::SurfaceLine& line : picture.lines) {
    EXPECT_EQ(line.normals[0], Vec3(-line.normals[1]));  // seen from above and from below
  }
  for (const viewer::IsoNumber& number : picture.numbers) {
    const bool is_inner = number.place.x() > 1 && number.place.x() < 5 &&
                          (number.place.x() < 2 || number.place.x() > 5);
    if (!is_inner) continue;
    // Positions on the scale are kept in single precision.
    EXPECT_NEAR(number.place.x(), number.value / 100, 1e-5);
  }
  look.numbers = true;
  const auto numbers =
      viewer::plane_picture(measured, ramp(measured), {.unit = "lux"}, look).numbers;
  ASSERT_EQ(numbers.size(), 23U);
  EXPECT_EQ(numbers[1].value, 150);
  EXPECT_EQ(numbers[1].place, measured.grid.point(1));
}

class Measuring : public OutputFolder {
 protected:
  void open_box() {
    open(desk_.session, kBox);
    viewer::update(desk_);
  }
  void measure() {
    wait_until(desk_.session, [&] {
      viewer::update(desk_);
      return desk_.session.is_idle() && desk_.meter.is_current(desk_.session);
    });
  }
  [[nodiscard]] const MeasuredGrid& plane() const { return *desk_.meter.readings()->plane; }

  viewer::Desk desk_{{.patches = {.n_patches = 100}}};
};

TEST_F(Measuring, IsTheFinalGatherOfTheLightOfNow) {
  EXPECT_THROW(viewer::show_work_plane(desk_, {}), radiosity::SceneError);
  open_box();
  EXPECT_THROW(viewer::show_work_plane(desk_, {.border = 5}), radiosity::SceneError);
  EXPECT_FALSE(desk_.meter.plane());
  viewer::show_work_plane(desk_, {.height = 0.1, .spacing = 0.1});
  EXPECT_EQ(desk_.look.show, viewer::Show::work_plane);
  EXPECT_TRUE(desk_.look.isolines);
  viewer::add_meter(desk_, Vec3(0.1, 0.2, 0.1), Vec3(0, 3, 0));
  EXPECT_FALSE(viewer::meter_value(desk_, 0));
  EXPECT_THROW(viewer::save_readings(desk_, (folder() / "m.csv").string()), radiosity::OutputError);
  measure();
  EXPECT_EQ(viewer::readings_note(desk_), "");
  const viewer::Model& model = desk_.session.model();
  const Eigen::VectorXd weights = radiosity::luminous_weights(model.bands);
  const auto expected = [&](const Vec3& point) {
    const radiosity::FinalGather gather(*model.mesh, desk_.session.light()->solution.radiosity);
    return weights.dot(gather.irradiance({&point, 1}, Vec3::UnitY()).row(0));
  };
  const radiosity::GridSummary found = viewer::plane_summary(desk_).value();
  EXPECT_GT(found.n_inside, 0);  // in the two boxes
  EXPECT_EQ(found.n + found.n_inside, plane().grid.size());
  const Eigen::VectorXd lux = viewer::measured_values(desk_.session, plane().irradiance);
  // To distant patches form factors are interpolated between the plane's points.
  EXPECT_NEAR(lux[0], expected(plane().grid.point(0)), 1e-4 * lux[0]);
  EXPECT_NEAR(viewer::meter_value(desk_, 0).value(), expected(Vec3(0.1, 0.2, 0.1)), 1e-9 * lux[0]);

  // What is seen of the plane can be pointed at, and measured again at that place.
  desk_.region = {.left = 0, .top = 0, .width = 800, .height = 800};
  const auto seen = viewer::plane_value_at(desk_, 0.5, 0.78);
  ASSERT_TRUE(seen);
  EXPECT_FALSE(viewer::plane_value_at(desk_, 0.5, 0.05));  // the ceiling
  ASSERT_TRUE(viewer::add_meter_at(desk_, 0.5, 0.78));
  EXPECT_NEAR(desk_.meter.points()[1].position.y(), 0.1, 1e-12);
  measure();
  EXPECT_NEAR(viewer::meter_value(desk_, 1).value(), *seen, 0.5 * *seen);  // half a cell away

  // With all lamps dimmed all is as much darker.
  for (std::size_t e = 0; e < desk_.session.mix().emitters.size(); ++e) {
    desk_.session.set_emitter(e, 0.25, true);
  }
  EXPECT_NE(viewer::readings_note(desk_), "");
  measure();
  EXPECT_NEAR(viewer::plane_summary(desk_)->mean, 0.25 * found.mean, 1e-6 * found.mean);
  EXPECT_NEAR(viewer::plane_summary(desk_)->least_to_mean(), found.least_to_mean(), 1e-6);
}

TEST_F(Measuring, KeepsPointsInAListAndInAFile) {
  open_box();
  desk_.region = {.left = 0, .top = 0, .width = 800, .height = 800};
  ASSERT_TRUE(viewer::add_meter_at(desk_, 0.5, 0.95));  // the floor
  viewer::add_meter(desk_, Vec3(0.1, 0.2, 0.1), Vec3::UnitY());
  viewer::show_work_plane(desk_, {.height = 0.2, .border = 0.1, .spacing = 0.2});
  measure();
  const viewer::MeterPoint first = desk_.meter.points()[0];
  EXPECT_EQ(first.surface, "floor");
  EXPECT_EQ(first.normal, Vec3::UnitY());
  const double lux = viewer::meter_value(desk_, 0).value();
  const Index n_inside = viewer::plane_summary(desk_)->n_inside;
  const std::string file = (folder() / "m.csv").string();
  EXPECT_THROW(viewer::save_readings(desk_, (folder() / "m.txt").string()), radiosity::OutputError);
  viewer::save_readings(desk_, file);
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "name,surface,x,y,z,normal_x,normal_y,normal_z,place,illuminance,H_0,H_1,H_2");
  Index n_rows = 0;
  Index n_empty = 0;
  std::string point_line;
  while (std::getline(stream, line)) {
    ++n_rows;
    if (line.ends_with(",inside,,,,")) ++n_empty;
    if (line.starts_with("point 1,floor,")) point_line = line;
  }
  EXPECT_EQ(n_rows, plane().grid.size() + 2);
  EXPECT_EQ(n_empty, n_inside);
  const std::size_t value = point_line.find(",open,");
  ASSERT_NE(value, std::string::npos);
  EXPECT_NEAR(std::stod(point_line.substr(value + 6)), lux, 1e-12 * lux);

  EXPECT_THROW(desk_.meter.remove(2), std::out_of_range);
  desk_.meter.remove(0);
  measure();
  EXPECT_EQ(desk_.meter.points().size(), 1U);
  // Of other patches the same places are measured; another file has others.
  desk_.session.restart({.patches = {.n_patches = 60}});
  settle(desk_.session);
  measure();
  EXPECT_EQ(desk_.meter.points().size(), 1U);
  viewer::hide_work_plane(desk_);
  EXPECT_EQ(desk_.look.show, viewer::Show::true_color);
  open(desk_.session, kRoom);
  viewer::update(desk_);
  EXPECT_TRUE(desk_.meter.points().empty());
}

}  // namespace
