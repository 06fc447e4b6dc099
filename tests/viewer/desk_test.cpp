// What the window shows and how, without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/painting.h"
#include "viewer/desk/picking.h"
#include "viewer/desk/show_info.h"
#include "viewer/desk/shown_scale.h"
#include "viewer/desk/spectrum.h"

namespace {

using radiosity::Vec3;
using namespace radiosity::test;
namespace fs = std::filesystem;

// A logarithmic scale says what it does: it never is a linear one in disguise.
TEST(ShownScale, IsLogarithmicWhereverALogarithmIs) {
  const Eigen::Vector4d values(0, 2, 50, 180);
  viewer::Look look{.logarithmic = true};
  EXPECT_TRUE(viewer::shown_scale(look, values).logarithmic);
  look.range = io::ColorScale{.low = 0, .high = 180};
  io::ColorScale scale = viewer::shown_scale(look, values);
  EXPECT_TRUE(scale.logarithmic);
  EXPECT_EQ(scale.low, 2);
  EXPECT_EQ(scale.high, 180);
  EXPECT_EQ(viewer::scale_note(look, scale), "logarithmic, from the least above 0");
  look.range->low = 10;
  EXPECT_EQ(viewer::scale_note(look, scale), "logarithmic");
  EXPECT_EQ(viewer::shown_scale(look, values).low, 10);
  look.range->low = -5;
  EXPECT_EQ(viewer::shown_scale(look, Eigen::Vector2d(1e-30, 180)).low, 180 * 1e-6);
  // Nothing to take a logarithm of: linear, and it says so.
  scale = viewer::shown_scale(look, -values);
  EXPECT_FALSE(scale.logarithmic);
  EXPECT_EQ(scale.low, -5);
  EXPECT_NE(viewer::scale_note(look, scale), "");
  look.logarithmic = false;
  EXPECT_EQ(viewer::scale_note(look, viewer::shown_scale(look, values)), "");
}

TEST(ShownScale, FitsWhatIsChosen) {
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(1001, 0, 1000);
  viewer::Look look;
  EXPECT_EQ(viewer::fit_text(look), "0 to 98 % of patches");
  look.fit = {.low_percent = 20, .high_percent = 70};
  EXPECT_EQ(viewer::shown_scale(look, values).low, 200);
  EXPECT_EQ(viewer::shown_scale(look, values).high, 700);
  EXPECT_EQ(viewer::fit_text(look), "20 to 70 % of patches");
  look.map = io::ColorMap::diverging;
  const io::ColorScale scale = viewer::shown_scale(look, values.array() - 600);
  EXPECT_EQ(scale.low, -scale.high);
  look.range = io::ColorScale{};
  EXPECT_EQ(viewer::fit_text(look), "as given");
}

// An end that is dragged goes where the hand is, and never past the other one.
TEST(ShownScale, FollowsTheHandThatDragsAnEnd) {
  const io::ColorScale linear = {.low = 0, .high = 200};
  EXPECT_NEAR(dragged_scale(linear, viewer::BarEnd::high, 0.5).high, 100, 1);
  EXPECT_EQ(dragged_scale(linear, viewer::BarEnd::high, 0.5).low, 0);
  EXPECT_NEAR(dragged_scale(linear, viewer::BarEnd::high, 1.5).high, 300, 1);
  EXPECT_NEAR(dragged_scale(linear, viewer::BarEnd::low, 0.25).low, 50, 1);
  const io::ColorScale logarithmic = {.low = 1, .high = 10000, .logarithmic = true};
  EXPECT_NEAR(dragged_scale(logarithmic, viewer::BarEnd::high, 0.5).high, 100, 1);
  EXPECT_NEAR(dragged_scale(logarithmic, viewer::BarEnd::low, 0.5).low, 100, 1);
  for (const io::ColorScale& scale : {linear, logarithmic}) {
    for (const double position : {-7.0, 0.0, 0.5, 1.0, 9.0}) {
      for (const viewer::BarEnd end : {viewer::BarEnd::low, viewer::BarEnd::high}) {
        const io::ColorScale dragged = dragged_scale(scale, end, position);
        EXPECT_LT(dragged.low, dragged.high) << position;
        EXPECT_TRUE(!scale.logarithmic || dragged.low > 0) << position;
      }
    }
  }
}

// What belongs to its own patch must not run into the neighbours.
TEST(Look, BlendsOnlyWhatVariesSmoothly) {
  viewer::Desk desk;
  for (const char* name : {"form-factors", "arriving", "light-path", "unshot", "error", "area"}) {
    viewer::show(desk, name);
    EXPECT_FALSE(viewer::is_smooth(desk.look)) << name;
  }
  for (const char* name : {"true-colour", "illuminance", "radiosity", "indirect"}) {
    viewer::show(desk, name);
    EXPECT_TRUE(viewer::is_smooth(desk.look)) << name;
  }
  viewer::show(desk, "form-factors");
  EXPECT_TRUE(desk.look.logarithmic);
  viewer::show(desk, "illuminance");
  EXPECT_FALSE(desk.look.logarithmic);
}

// Whoever reads the list for the first time is told what each entry is.
TEST(ShowInfo, TellsAllThatCanBeShown) {
  const auto groups = viewer::show_groups();
  radiosity::Bands spectral;
  spectral.kind = radiosity::Bands::Kind::wavelengths;
  spectral.wavelengths = {500, 600};
  for (const viewer::ShowName& name : viewer::show_names()) {
    SCOPED_TRACE(name.name);
    const viewer::ShowInfo& info = viewer::show_info(name.name);
    EXPECT_EQ(info.name, name.name);
    EXPECT_EQ(std::count(groups.begin(), groups.end(), info.group), 1);
    EXPECT_FALSE(info.caption.empty());
    EXPECT_TRUE(info.definition.ends_with("."));
    if (name.show != viewer::Show::quantity) continue;
    EXPECT_EQ(info.unit, radiosity::quantity_info(name.quantity).unit);
  }
  EXPECT_EQ(caption_with_unit(viewer::show_info("illuminance"), spectral), "illuminance (lux)");
  EXPECT_EQ(caption_with_unit(viewer::show_info("radiosity"), spectral), "radiosity (W/(m² nm))");
  EXPECT_EQ(caption_with_unit(viewer::show_info("power"), spectral), "power (W/nm)");
  EXPECT_EQ(caption_with_unit(viewer::show_info("area"), spectral), "area of the patches (m²)");
  EXPECT_EQ(caption_with_unit(viewer::show_info("reflectance"), {}), "reflectance");
}

TEST(PatchFacts, NumbersAreAsAPersonWritesThem) {
  EXPECT_EQ(viewer::number_text(16411.3), "16410");
  EXPECT_EQ(viewer::number_text(79.928), "79.93");
  EXPECT_EQ(viewer::number_text(0), "0");
  EXPECT_EQ(viewer::number_text(0.25), "0.2500");
  EXPECT_EQ(viewer::number_text(-3.14159), "-3.142");
  EXPECT_EQ(viewer::number_text(0.01523), "0.01523");
  EXPECT_EQ(viewer::number_text(480.43), "480.4");
  EXPECT_EQ(viewer::number_text(1.5e-7), "1.5e-07");
  EXPECT_EQ(viewer::number_text(122.7, 2), "120");
  EXPECT_EQ(viewer::number_text(0.0567, 2), "0.057");
  EXPECT_EQ(viewer::numbers_text(Eigen::Vector2d(1, 20), true), "≈ 1.0  20");
  EXPECT_EQ(viewer::errors_text(Eigen::Vector2d(0.0004142, 7.69e-5)), "0.00041  7.7e-05");
  EXPECT_EQ(viewer::numbers_text(Eigen::VectorXd::LinSpaced(76, 1, 3)), "1.00 to 3.00");
}

TEST(Spectrum, TellsTheBandUnderTheMouse) {
  radiosity::Bands bands;
  bands.kind = radiosity::Bands::Kind::wavelengths;
  bands.wavelengths = {400, 500, 550, 700};
  EXPECT_EQ(viewer::nearest_band(bands, 300), 0);
  EXPECT_EQ(viewer::nearest_band(bands, 524), 1);
  EXPECT_EQ(viewer::nearest_band(bands, 526), 2);
  EXPECT_EQ(viewer::nearest_band(bands, 900), 3);
  viewer::PatchFacts facts;
  facts.radiosity = Eigen::Vector4d(1, 2, 0.25, 3);
  facts.irradiance = Eigen::Vector4d(5, 7.5, 1, 2);
  facts.reflectance = Eigen::Vector4d(0.1, 0.2, 0.25, 0.4);
  EXPECT_EQ(viewer::band_text(facts, bands, 2), "550 nm: B 0.250, H 1.00 W/(m² nm), ρ 0.250");
  const viewer::SpectrumAxes axes = viewer::spectrum_axes(bands, facts.radiosity, facts.irradiance);
  EXPECT_EQ(axes.wavelengths.low, 400);
  EXPECT_EQ(axes.wavelengths.high, 700);
  EXPECT_EQ(axes.values.low, 0);
  EXPECT_GE(axes.values.high, 7.5);
}

// What is white must look white in any bands, and red red.
TEST(SurfaceColors, AreThoseOfTheSurfaces) {
  const radiosity::Scene scene =
      io::read_scene(std::string(RADIOSITY_SCENES) + "/cornell-box-spectral.json");
  for (const radiosity::Material& material : scene.materials) {
    const Eigen::RowVector3f color =
        viewer::surface_colors(material.reflectance.transpose(), scene.bands).row(0);
    EXPECT_LT(color.maxCoeff(), 1) << material.name;
    if (material.name == "red") {
      EXPECT_GT(color[0], 3 * color[1]);
    }
    if (material.name == "green") {
      EXPECT_GT(color[1], 2 * color[0]);
    }
  }
  const Eigen::MatrixXd all = Eigen::MatrixXd::Ones(1, scene.bands.count());
  EXPECT_LE((viewer::surface_colors(all, scene.bands).array() - 1).abs().maxCoeff(), 1e-6);
}

class Desks : public OutputFolder {
 protected:
  /// An office of 4 m x 3 m x 2.5 m as modellers write them: in mm, z up.
  std::string write_office() const {
    const fs::path path = folder() / "office.obj";
    std::ofstream(path) << "v 0 0 0\nv 4000 0 0\nv 4000 3000 0\nv 0 3000 0\n"
                           "v 0 0 2500\nv 4000 0 2500\nv 4000 3000 2500\nv 0 3000 2500\n"
                           "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
    return path.string();
  }
};

TEST_F(Desks, TakeUnitAndUpAxis) {
  viewer::Desk desk(coarse());
  const std::string office = write_office();
  const auto open_in = [&](const std::function<void()>& begin) {
    begin();
    wait_until(desk.session, [&] { return desk.session.is_idle(); });
    viewer::update(desk);
  };
  open_in([&] { desk.session.open(office); });
  EXPECT_EQ(desk.up, viewer::UpAxis::z);
  EXPECT_EQ(desk.camera.camera().up, Vec3::UnitZ());
  EXPECT_NEAR(radiosity::bounds(*desk.session.model().mesh).sizes().x(), 4000, 1e-9);
  open_in([&] { viewer::set_unit(desk, "mm"); });
  EXPECT_NEAR(radiosity::bounds(*desk.session.model().mesh).sizes().x(), 4, 1e-12);
  EXPECT_THROW(viewer::set_unit(desk, "ell"), radiosity::SceneError);
  viewer::set_up(desk, viewer::UpAxis::y);
  EXPECT_EQ(desk.camera.camera().up, Vec3::UnitY());
}

TEST_F(Desks, KeepThePlaceThatIsAskedWhenSolvedAgain) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  viewer::update(desk);
  desk.session.select(100);
  viewer::update(desk);
  const viewer::PatchFacts before = *desk.facts;
  desk.session.restart({.patches = {.n_patches = 100}});
  settle(desk.session);
  viewer::update(desk);
  ASSERT_TRUE(desk.facts);
  EXPECT_EQ(desk.facts->polygon, before.polygon);
  EXPECT_LE((desk.facts->centroid - before.centroid).norm(), 0.2);  // of a box of 0.55 m
  // But nobody is asked in another file.
  open(desk.session, kRoom);
  viewer::update(desk);
  EXPECT_FALSE(desk.session.selected());
}

// A scene that was saved while a lamp was off is dark, and the lamp can be switched on again.
TEST_F(Desks, SaveLampsThatCanBeSwitchedOnAgain) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  viewer::update(desk);
  const Eigen::MatrixXd lit = desk.session.light()->solution.radiosity;
  desk.session.set_emitter(0, 0.6, false);
  desk.session.set_reflectance(0, Eigen::Vector3d(0.5, 0.4, 0.3));
  settle(desk.session);
  const radiosity::Camera camera = desk.camera.camera();
  viewer::save_view(desk.views, "from the door", camera);
  viewer::fit_camera(desk);
  const std::string file = (folder() / "dark.json").string();
  viewer::save_scene(desk, file);

  const auto scene = desk.session.model().scene;
  const radiosity::Scene saved = io::read_scene(file);
  EXPECT_EQ(saved.name, "Cornell box");
  EXPECT_EQ(saved.description, scene->description);
  ASSERT_EQ(saved.materials.size(), scene->materials.size());
  ASSERT_EQ(saved.surfaces.size(), scene->surfaces.size());
  EXPECT_EQ(saved.materials[0].reflectance, Eigen::Vector3d(0.5, 0.4, 0.3));

  open(desk.session, file);
  viewer::update(desk);
  EXPECT_EQ(desk.session.light()->solution.radiosity.norm(), 0);
  // Views are in the file, too.
  ASSERT_EQ(desk.views.size(), 1U);
  EXPECT_EQ(desk.views[0].name, "from the door");
  EXPECT_NE(desk.camera.camera().position, camera.position);
  viewer::use_view(desk, "from the door");
  EXPECT_EQ(desk.camera.camera().position, camera.position);
  // Its exposure is found once there is light, and kept if it was known before.
  const viewer::PaintingTask dark = {.known = desk.session.known(), .look = desk.look};
  EXPECT_TRUE(viewer::make_painting(dark).is_spreading);
  viewer::PaintingTask exposed = dark;
  exposed.exposure = 0.3;
  EXPECT_FALSE(viewer::make_painting(exposed).is_spreading);
  ASSERT_EQ(desk.session.mix().emitters.size(), 1U);
  EXPECT_FALSE(desk.session.mix().emitters[0].is_on);
  desk.session.set_emitter(0, 1, true);
  desk.session.set_reflectance(0, scene->materials[0].reflectance);
  settle(desk.session);
  // (The patches are those of the same polygons.)
  const Eigen::MatrixXd again = desk.session.light()->solution.radiosity;
  EXPECT_LE((again - lit).norm(), 1e-6 * lit.norm());
}

// Which patches a warning is about can be seen.
TEST_F(Desks, ShowThePatchesThatSeeAnOpening) {
  study::StudyOptions options = coarse();
  options.closed = radiosity::Closed::yes;
  viewer::Desk desk(options);
  open(desk.session, std::string(RADIOSITY_SCENES) + "/opposed-squares.json");
  viewer::update(desk);
  const viewer::Known known = desk.session.known();
  ASSERT_TRUE(viewer::open_patches(known));
  EXPECT_EQ(viewer::open_patches(known)->size(), known.model.mesh->corners.size());
  const auto& messages = desk.session.messages();
  EXPECT_EQ(std::count_if(messages.begin(), messages.end(),
                          [](const viewer::Message& message) { return message.is_about_openings; }),
            1);
  viewer::show(desk, "unseen");
  const auto field = viewer::shown_field(known, desk.look);
  ASSERT_TRUE(field);
  for (radiosity::Index i = 0; i < known.model.mesh->size(); ++i) {
    EXPECT_NEAR(field->values[i], 1 - rows_of(*known.model.transport).row(i).sum(), 1e-6);
  }
  // A closed scene has none, and nothing is said of them.
  open(desk.session, kThermal);
  EXPECT_TRUE(viewer::open_patches(desk.session.known())->empty());
  EXPECT_FALSE(desk.session.messages().back().is_about_openings &&
               !desk.session.messages().back().is_past);
}

// An error of another file must not look like one of the scene that is open.
TEST_F(Desks, KnowWhichMessagesAreAboutWhatIsOpen) {
  viewer::Desk desk(coarse());
  const std::string missing = (folder() / "none.json").string();
  open(desk.session, missing);
  ASSERT_EQ(desk.session.messages().size(), 1U);
  EXPECT_FALSE(desk.session.messages().back().is_past);
  EXPECT_EQ(viewer::messages_text(desk.session),
            "error: " + desk.session.messages()[0].text + "\n");
  open(desk.session, kRoom);
  for (const viewer::Message& message : desk.session.messages()) {
    EXPECT_EQ(message.is_past, message.text.find("none.json") != std::string::npos);
  }
  // One that cannot be read takes no message of what stays open away.
  desk.session.tell("about the room");
  open(desk.session, missing);
  EXPECT_FALSE(desk.session.messages()[desk.session.messages().size() - 2].is_past);
  EXPECT_FALSE(desk.session.messages().back().is_past);
  for (const int lines : {-3, 1, 12, 100000}) {
    viewer::set_console_lines(desk, lines);
    EXPECT_GE(desk.console_lines, 1);
    EXPECT_LE(desk.console_lines, 100);
  }
}

// A point is where a ray meets a surface, or the corner beside it.
TEST_F(Desks, FindThePointUnderTheMouse) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  viewer::update(desk);
  desk.region = {.left = 0, .top = 0, .width = 600, .height = 600};
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  for (const double x : {0.2, 0.5, 0.81}) {
    const Vec3 point = viewer::point_towards(desk, x, 0.7);
    const auto patch = viewer::patch_at(desk, x, 0.7);
    ASSERT_TRUE(patch);
    EXPECT_LE(std::abs(mesh.normal[*patch].dot(point - mesh.centroid[*patch])), 1e-6);
    const auto drawn = viewer::point_at(desk, x, 0.7);
    ASSERT_TRUE(drawn);
    EXPECT_LE((*drawn - point).norm(), 0.05);  // some pixels of a box of 0.55 m
  }
  viewer::save_view(desk.views, "here", desk.camera.camera());
  const Vec3 before = desk.camera.camera().position;
  desk.camera.zoom_to(viewer::point_towards(desk, 0.3, 0.6), 0.5);
  EXPECT_GT((desk.camera.camera().position - before).norm(), 0.1);
  viewer::use_view(desk, "here");
  EXPECT_EQ(desk.camera.camera().position, before);
  open(desk.session, kRoom);  // where nothing of it is
  viewer::update(desk);
  EXPECT_TRUE(desk.views.empty());
}

// What was set for one scene must not hide the next one, and heat is nothing to see.
TEST_F(Desks, GreetEachFileAfresh) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  viewer::update(desk);
  viewer::show(desk, "illuminance");
  desk.look.range = io::ColorScale{.low = 0, .high = 180};
  desk.look.logarithmic = true;
  open(desk.session, kThermal);
  viewer::update(desk);
  EXPECT_FALSE(desk.look.range);
  EXPECT_FALSE(desk.look.logarithmic);
  EXPECT_EQ(viewer::show_name(desk.look), "net-flux");
  for (const viewer::ShowName& name : viewer::show_names()) {
    const bool is_seen = name.name == "true-colour" || name.name.starts_with("lumin") ||
                         name.name == "illuminance" ||
                         name.name == "grid";  // of which there is none
    EXPECT_EQ(viewer::is_offered(name, desk.session), !is_seen) << name.name;
  }
  desk.session.select(0);
  viewer::update(desk);
  EXPECT_GT(desk.facts->temperature.value(), 0);
  open(desk.session, kBox);
  viewer::update(desk);
  EXPECT_EQ(viewer::show_name(desk.look), "true-colour");
}

}  // namespace
