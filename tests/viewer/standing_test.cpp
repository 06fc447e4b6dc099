// What the viewer tells of its light while it is being found, and what it then lets out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "io/result/form_factor_file.h"
#include "io/result/operator_file.h"
#include "io/result/result_file.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/output_folder.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/work/standing.h"

namespace {

using radiosity::Index;
using viewer::Light;
using namespace radiosity::test;
namespace fs = std::filesystem;

double deviation(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

// Opening what cannot be read must cost nothing: neither the light nor the work under way.
TEST(Session, GoesOnSolvingIfTheNextFileIsBad) {
  viewer::Session session({.patches = {.n_patches = 1500}});
  session.open(kBox);
  wait_until(session, [&] { return session.light() != nullptr; });
  ASSERT_EQ(session.model().transport, nullptr);
  session.open(std::string(RADIOSITY_SCENES) + "/README.md");
  wait_until(session, [&] { return !session.messages().empty(); });
  EXPECT_TRUE(session.messages().back().is_error);
  EXPECT_FALSE(session.is_settled());
  settle(session);
  EXPECT_EQ(session.light()->kind, Light::Kind::complete);
}

// A lamp that is switched before there are form factors is switched in the preview.
TEST(Session, PreviewFollowsTheMix) {
  viewer::Session session({.patches = {.n_patches = 20000}});
  session.open(kBox);
  wait_until(session, [&] { return session.light() != nullptr; });
  const double lit = session.light()->solution.exitance.sum();
  session.set_emitter(0, 0.5, true);
  EXPECT_TRUE(session.is_change_pending());
  wait_until(session, [&] { return !session.is_change_pending(); });
  EXPECT_EQ(session.light()->kind, Light::Kind::preview);
  EXPECT_NEAR(session.light()->solution.exitance.sum(), 0.5 * lit, 1e-9 * lit);
  EXPECT_GT(session.change_seconds(), 0);
  // Also a slider that does not rest.
  int version = session.versions().light;
  int n_pictures = 0;
  for (int k = 0; n_pictures < 3 && k < 60000; ++k) {
    session.set_emitter(0, 0.5 + 0.01 * (k % 100), true);
    std::this_thread::sleep_for(1ms);
    session.update();
    if (session.versions().light != version) ++n_pictures;
    version = session.versions().light;
  }
  EXPECT_GE(n_pictures, 3);
}

// Nobody may take a preview for a result, and who waits is told so until all is known.
TEST(Session, TellsHowFarItCanBeTrusted) {
  viewer::Session session({.patches = {.n_patches = 800}});
  EXPECT_EQ(viewer::standing(session).text, "");
  session.open(kBox);
  std::set<Light::Kind> seen;
  double fraction = 0;
  wait_until(session, [&] {
    EXPECT_GE(session.is_idle() ? 1 : session.job().fraction(), fraction);
    fraction = session.job().fraction();
    if (session.light() == nullptr) return false;
    const viewer::Standing now = viewer::standing(session);
    const Light::Kind kind = session.light()->kind;
    seen.insert(kind);
    EXPECT_EQ(now.is_result, kind == Light::Kind::complete);
    EXPECT_EQ(now.is_rough, kind == Light::Kind::preview);
    EXPECT_EQ(now.text.find("preview") != std::string::npos, kind == Light::Kind::preview);
    return session.is_idle();
  });
  EXPECT_TRUE(seen.contains(Light::Kind::preview));
  EXPECT_TRUE(seen.contains(Light::Kind::complete));
  const auto& solution = session.light()->solution;
  const Eigen::Map<const Eigen::VectorXd> area(session.model().mesh->area.data(),
                                               session.model().mesh->size());
  double expected = 0;
  for (Index b = 0; b < 3; ++b) {
    const double error = std::sqrt(area.dot(solution.radiosity_error.col(b).cwiseAbs2()));
    expected =
        std::max(expected, 2 * error / std::sqrt(area.dot(solution.radiosity.col(b).cwiseAbs2())));
  }
  EXPECT_NEAR(session.light()->relative_error.value(), expected, 1e-12);
  const std::string accuracy = viewer::accuracy_text(session);
  EXPECT_EQ(viewer::standing(session).text, "solved, " + accuracy);
  session.set_reflectance(1, Eigen::Vector3d::Constant(0.2));
  EXPECT_FALSE(viewer::standing(session).is_result);
  EXPECT_EQ(viewer::accuracy_text(session), "");
}

// One patch for each surface: nothing tells what their size makes wrong, and so nobody knows how
// far the light is off.
TEST(Session, DoesNotClaimToKnowWhatOnePatchASurfaceCosts) {
  viewer::Session session({.patches = {.as_is = true}});
  open(session, std::string(RADIOSITY_SCENES) + "/furnace-cube.json");
  for (const double reflectance : {0.3, 0.6}) {
    ASSERT_TRUE(session.has_result());
    EXPECT_EQ(session.light()->relative_error, std::nullopt);
    EXPECT_EQ(viewer::accuracy_text(session), "");
    EXPECT_EQ(viewer::standing(session).text, "solved, errors not known");
    session.set_reflectance(0, Eigen::VectorXd::Constant(1, reflectance));
    settle(session);
  }
  EXPECT_EQ(std::count_if(session.messages().begin(), session.messages().end(),
                          [](const viewer::Message& message) {
                            return message.text.find("one patch only") != std::string::npos;
                          }),
            1);
}

// While a compressed operator is being made, a rough one shows the light, says how rough it is, and
// answers what lamps and materials would do.
TEST(Session, GoesOnWithRoughFormFactorsUntilTheyAreMade) {
  viewer::Session session(
      {.patches = {.n_patches = 3000}, .transport = radiosity::TransportKind::compressed});
  session.open(kBox);
  const auto is_rough = [&] {
    return session.light() != nullptr && session.light()->factor_error.has_value();
  };
  wait_until(session, is_rough);
  ASSERT_EQ(session.model().transport, nullptr);
  EXPECT_EQ(session.light()->kind, Light::Kind::preview);
  const double error = *session.light()->factor_error;
  EXPECT_GT(error, 1e-2);
  const viewer::Standing now = viewer::standing(session);
  EXPECT_TRUE(now.is_rough);
  EXPECT_FALSE(now.is_result);
  EXPECT_FALSE(session.has_result());
  EXPECT_NE(now.text.find("preview: form factors to about"), std::string::npos) << now.text;
  EXPECT_NE(now.text.find(std::to_string(static_cast<int>(std::ceil(100 * error)))),
            std::string::npos)
      << now.text;
  const Eigen::MatrixXd rough = session.light()->solution.radiosity;

  const double lit = session.light()->solution.exitance.sum();
  session.set_emitter(0, 0.5, true);
  wait_until(session, [&] { return !session.is_change_pending(); });
  ASSERT_EQ(session.model().transport, nullptr);
  EXPECT_TRUE(is_rough());
  EXPECT_NEAR(session.light()->solution.exitance.sum(), 0.5 * lit, 1e-9 * lit);
  // Light is proportional to its only source, but for the iteration's 1e-3.
  EXPECT_LE(deviation(session.light()->solution.radiosity, 0.5 * rough), 3e-3);
  const double before = session.light()->solution.radiosity.sum();
  session.set_reflectance(1, Eigen::Vector3d::Constant(0.1));
  wait_until(session, [&] { return !session.is_change_pending(); });
  EXPECT_LT(session.light()->solution.radiosity.sum(), before);

  session.reset_mix();
  settle(session);
  EXPECT_EQ(session.light()->kind, Light::Kind::complete);
  EXPECT_FALSE(is_rough());
  // (I - ρ F)⁻¹ makes errors of F larger, by less than 1 / (1 - ρ) with ρ = 0.8.
  EXPECT_LE(deviation(rough, session.light()->solution.radiosity), 5 * error);
}

class Results : public OutputFolder {};

TEST_F(Results, OpenWithoutBeingSolvedAgain) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  const std::string vtp = (folder() / "box.vtp").string();
  const std::string h5 = (folder() / "box.h5").string();
  const std::string json = (folder() / "box.json").string();
  viewer::update(desk);
  desk.camera.orbit(0.4, 0.1);
  const radiosity::Camera camera = desk.camera.camera();
  viewer::save_result(desk, vtp);
  viewer::save_scene(desk, json);
  io::write_form_factors(h5, *desk.session.model().mesh, *desk.session.model().transport);
  const auto light = *desk.session.light();
  const auto mesh = desk.session.model().mesh;
  const Eigen::VectorXd row = rows_of(*desk.session.model().transport).row(5);
  const std::string accuracy = viewer::accuracy_text(desk.session);

  open(desk.session, vtp);
  ASSERT_NE(desk.session.light(), nullptr);
  EXPECT_EQ(desk.session.light()->kind, Light::Kind::stored);
  EXPECT_EQ(desk.session.light()->solution.radiosity, light.solution.radiosity);
  EXPECT_EQ(viewer::standing(desk.session).text, "result from a file, " + accuracy);
  EXPECT_EQ(desk.session.light()->solution.radiosity_error, light.solution.radiosity_error);
  EXPECT_EQ(desk.session.model().mesh->vertices, mesh->vertices);
  EXPECT_FALSE(desk.session.model().factors);
  viewer::update(desk);
  EXPECT_EQ(desk.camera.camera().position, camera.position);
  EXPECT_EQ(desk.camera.camera().vertical_fov, camera.vertical_fov);
  fs::create_hard_link(vtp, folder() / "link.vtp");
  for (const char* name : {"box.vtp", "./box.vtp", "link.vtp"}) {
    EXPECT_THROW(viewer::save_result(desk, (folder() / name).string()), radiosity::OutputError);
  }

  open(desk.session, h5);
  viewer::update(desk);
  EXPECT_EQ(viewer::show_name(desk.look), "form-factors");
  EXPECT_EQ(desk.session.light(), nullptr);
  EXPECT_EQ(desk.session.model().mesh->corners, mesh->corners);
  ASSERT_TRUE(desk.session.model().factors);
  EXPECT_LE((desk.session.model().factors->row(5) - row).norm(), 1e-12);
  desk.session.restart(coarse());
  EXPECT_TRUE(desk.session.messages().back().is_error);

  const radiosity::Visibility visibility(*mesh);
  const auto compressed = radiosity::make_compressed_transport(*mesh, visibility);
  io::write_operator(h5, *mesh, *compressed);
  open(desk.session, h5);
  ASSERT_TRUE(desk.session.model().factors);
  EXPECT_EQ(desk.session.model().factors->row(5), compressed->row(5));

  open(desk.session, json);
  EXPECT_LE(deviation(desk.session.light()->solution.radiosity, light.solution.radiosity), 1e-7);
  EXPECT_THROW(viewer::save_scene(desk, json), radiosity::OutputError);
}

// Neither a preview nor light without its errors, nor of a mix that is not the one shown, may leave
// as a result.
TEST_F(Results, AreSavedOnlyOnceTheyAre) {
  viewer::Desk desk({.patches = {.n_patches = 800}});
  desk.session.open(kBox);
  const std::string file = (folder() / "box.csv").string();
  std::set<Light::Kind> refused;
  const auto save = [&] {
    try {
      viewer::save_result(desk, file);
      return true;
    } catch (const radiosity::OutputError&) {
      return false;
    }
  };
  while (!desk.session.is_settled() || desk.session.light() == nullptr) {
    desk.session.update();
    const bool is_result =
        desk.session.light() != nullptr && desk.session.light()->kind == Light::Kind::complete;
    EXPECT_EQ(save(), is_result);
    if (desk.session.light() != nullptr && !is_result) refused.insert(desk.session.light()->kind);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  settle(desk.session);
  EXPECT_TRUE(refused.contains(Light::Kind::preview));
  EXPECT_TRUE(save());
  desk.session.set_emitter(0, 0.25, true);
  EXPECT_FALSE(save());
  settle(desk.session);
  EXPECT_TRUE(save());
}

// The window goes on while a file is written, and tells what became of it.
TEST_F(Results, AreWrittenInTheBackground) {
  viewer::Desk desk(coarse());
  EXPECT_THROW(viewer::begin_save_result(desk, (folder() / "none.csv").string()),
               radiosity::OutputError);
  open(desk.session, kBox);
  viewer::update(desk);
  const std::string file = (folder() / "box.csv").string();
  const auto wait = [&] {
    wait_until(desk.session, [&] {
      viewer::update(desk);
      return desk.saving.empty();
    });
  };
  viewer::begin_save_result(desk, file);
  EXPECT_EQ(desk.saving, file);
  EXPECT_THROW(viewer::begin_save_result(desk, (folder() / "other.csv").string()),
               radiosity::OutputError);
  wait();
  EXPECT_FALSE(desk.save_error);
  EXPECT_EQ(desk.session.messages().back().text, "saved " + file);
  const std::string same = (folder() / "same.csv").string();
  viewer::save_result(desk, same);
  EXPECT_EQ(fs::file_size(file), fs::file_size(same));
  viewer::begin_save_result(desk, (folder() / "nowhere" / "box.csv").string());
  wait();
  EXPECT_TRUE(desk.save_error);
  EXPECT_TRUE(desk.session.messages().back().is_error);
}

// A lamp that is dimmed and a wall that is painted must be in the scene that is saved.
TEST_F(Results, SavedSceneHasTheChanges) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  desk.session.set_emitter(0, 0.25, true);
  desk.session.set_reflectance(1, Eigen::Vector3d(0.1, 0.5, 0.9));
  settle(desk.session);
  const Eigen::MatrixXd expected = desk.session.light()->solution.radiosity;
  const std::string json = (folder() / "changed.json").string();
  viewer::save_scene(desk, json);
  open(desk.session, json);
  EXPECT_LE(deviation(desk.session.light()->solution.radiosity, expected), 1e-7);
}

}  // namespace
