// What the viewer computes in the background, without a window.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"

namespace {

using radiosity::Index;
using viewer::Light;
using namespace radiosity::test;

/// The radiosity of the mix from a solve that knows nothing of other mixes.
Eigen::MatrixXd fresh_radiosity(const viewer::Session& session) {
  const radiosity::Scene scene = viewer::mixed_scene(*session.model().scene, session.mix());
  return solve(*session.model().transport, exitance(scene, *session.model().mesh),
               reflectance(scene, *session.model().mesh), {.estimates_errors = false})
      .radiosity;
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

TEST(Session, SolvesWhatTheLibrarySolves) {
  viewer::Session session(coarse());
  open(session, kBox);
  ASSERT_NE(session.light(), nullptr);
  EXPECT_EQ(session.light()->kind, Light::Kind::complete);
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-7);
  EXPECT_GT(session.light()->solution.radiosity_error.maxCoeff(), 0);
  EXPECT_GT(session.seconds_to_solve(), 0);
  for (const viewer::Message& message : session.messages()) {
    EXPECT_FALSE(message.is_error) << message.text;
  }
}

/// The error in the console; "" if there is none.
std::string last_error(const viewer::Session& session) {
  for (auto i = session.messages().rbegin(); i != session.messages().rend(); ++i) {
    if (i->is_error) return i->text;
  }
  return "";
}

TEST(Session, ShowsUnsolvedWhatDoesNotFitIntoMemory) {
  study::StudyOptions options = coarse();
  options.memory = 1000;  // too little for the polygons, too
  viewer::Session session(options);
  open(session, kBox);
  ASSERT_TRUE(session.is_open());
  const radiosity::PatchMesh as_is = meshing::make_patches(*session.model().scene);
  EXPECT_EQ(session.model().mesh->size(), as_is.size());
  EXPECT_EQ(session.model().transport, nullptr);
  EXPECT_EQ(session.light(), nullptr);
  EXPECT_NE(last_error(session).find(", but 1e-06 GB can be used"), std::string::npos)
      << last_error(session);
}

TEST(Session, RefusesMorePatchesThanAnyMachineHolds) {
  if (radiosity::usable_memory() == 0) GTEST_SKIP() << "this machine does not tell what it has";
  viewer::Session session({.patches = {.n_patches = 2'000'000'000}});
  open(session, kBox);
  EXPECT_TRUE(session.is_open());
  EXPECT_EQ(session.light(), nullptr);
  EXPECT_NE(last_error(session).find("2000000000 patches"), std::string::npos)
      << last_error(session);
}

// More patches than there is memory for cost nothing of what there is: neither the light nor the
// work under way.
TEST(Session, KeepsWhatIsOpenIfMorePatchesAreRefused) {
  viewer::Session session(coarse());
  session.open(kBox);
  wait_until(session, [&] { return session.is_open(); });
  study::StudyOptions options = coarse();
  options.memory = 1000;
  for (const bool is_solved : {false, true}) {
    if (is_solved) settle(session);
    const auto mesh = session.model().mesh;
    session.restart(options);
    wait_until(session, [&] { return !last_error(session).empty(); });
    EXPECT_EQ(session.model().mesh, mesh);
    EXPECT_EQ(session.refusal(), last_error(session));  // for a script that waits for it
    EXPECT_EQ(session.options().memory, coarse().memory);
    EXPECT_NE(last_error(session).find("1e-06 GB can be used"), std::string::npos);
    session.clear_messages();
  }
  settle(session);
  EXPECT_EQ(session.light()->kind, Light::Kind::complete);
  EXPECT_TRUE(session.has_result());
}

TEST(Session, ShowsALightThatSpreadsBeforeItIsSolved) {
  viewer::Session session({.patches = {.n_patches = 1000}});
  session.open(kBox);
  double unshot = 1;
  int n_previews = 0;
  int version = 0;
  wait_until(session, [&] {
    const Light* light = session.light();
    if (light == nullptr || light->kind != Light::Kind::preview) return light != nullptr;
    if (session.versions().light == version) return false;
    version = session.versions().light;
    EXPECT_LE(session.unshot_share(), unshot);
    unshot = session.unshot_share();
    ++n_previews;
    return false;
  });
  EXPECT_GE(n_previews, 1);
  EXPECT_LT(unshot, 1);
}

TEST(Session, SwitchingLampsEqualsAFreshSolve) {
  for (const std::string& path : {kBox, kThermal}) {
    SCOPED_TRACE(path);
    viewer::Session session(coarse());
    open(session, path);
    ASSERT_TRUE(session.can_superpose());
    for (std::size_t e = 0; e < session.mix().emitters.size(); ++e) {
      session.set_emitter(e, 0.3 + 0.4 * static_cast<double>(e), e % 3 != 1);
      // At once, before anything is solved.
      const Eigen::MatrixXd shown = session.light()->solution.radiosity;
      EXPECT_LE((shown - fresh_radiosity(session)).norm(), 1e-6 * (1 + shown.norm()));
    }
    settle(session);
    EXPECT_EQ(session.light()->kind, Light::Kind::complete);
    EXPECT_LE((session.light()->solution.radiosity - fresh_radiosity(session)).norm(),
              1e-6 * (1 + session.light()->solution.radiosity.norm()));
  }
}

TEST(Session, ChangedReflectanceEqualsAFreshSolve) {
  viewer::Session session(coarse());
  open(session, kBox);
  const Eigen::VectorXd white = Eigen::Vector3d(0.9, 0.85, 0.8);
  const int version = session.versions().light;
  session.set_reflectance(1, white);
  EXPECT_FALSE(session.can_superpose());
  wait_until(session, [&] { return session.versions().light != version; });
  // A picture's accuracy first...
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-3);
  settle(session);
  // ... then that of any solve; and lamps can be switched again.
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-7);
  ASSERT_TRUE(session.can_superpose());
  session.set_emitter(0, 2, true);
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-6);
  session.reset_mix();
  settle(session);
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-7);
  EXPECT_EQ(session.mix().emitters[0].scale, 1);
}

// What was stopped before its first picture must not hold later changes back.
TEST(Session, FollowsAReflectanceAfterAStop) {
  viewer::Session session({.patches = {.n_patches = 600}});
  open(session, kBox);
  session.set_reflectance(0, Eigen::Vector3d::Constant(0.3));
  session.stop();
  session.set_reflectance(0, Eigen::Vector3d::Constant(0.4));
  settle(session);
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-7);
}

// A slider that moves all the time must not starve the picture.
TEST(Session, FollowsAReflectanceThatKeepsChanging) {
  viewer::Session session({.patches = {.n_patches = 800}});
  open(session, kBox);
  int version = session.versions().light;
  int n_pictures = 0;
  // However fast or slow the machine is, pictures come while the mouse moves.
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  for (int k = 0; n_pictures < 3 && std::chrono::steady_clock::now() < deadline; ++k) {
    session.set_reflectance(0, Eigen::Vector3d::Constant(0.2 + 0.003 * (k % 200)));
    std::this_thread::sleep_for(1ms);  // less than a solve takes
    session.update();
    if (session.versions().light != version) ++n_pictures;
    version = session.versions().light;
  }
  EXPECT_GE(n_pictures, 3);
  settle(session);
  EXPECT_LE(difference(session.light()->solution.radiosity, fresh_radiosity(session)), 1e-7);
}

TEST(Session, FactsOfAPatchAreThoseOfTheOperator) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  const auto& transport = *desk.session.model().transport;
  const auto& solution = desk.session.light()->solution;
  for (const Index patch : {Index{0}, Index{77}, transport.size() - 1}) {
    desk.session.select(patch);
    viewer::update(desk);
    ASSERT_TRUE(desk.facts);
    const Eigen::VectorXd row = rows_of(transport).row(patch);
    const Eigen::VectorXd error = rows_of(transport).row_error(patch);
    EXPECT_EQ(desk.facts->row_sum, row.sum());
    ASSERT_LE(desk.facts->partners.size(), 10U);
    Eigen::VectorXd rest = row;
    for (const viewer::Partner& partner : desk.facts->partners) {
      EXPECT_EQ(partner.factor, row[partner.patch]);
      EXPECT_EQ(partner.error, error[partner.patch]);
      EXPECT_EQ(partner.factor, rest.maxCoeff());  // the largest of those that are left
      rest[partner.patch] = 0;
    }
    const Eigen::VectorXd direct = solution.exitance.transpose() * row;
    EXPECT_EQ(desk.facts->direct, direct);
    EXPECT_TRUE((desk.facts->direct.array() <= desk.facts->irradiance.array() + 1e-12).all());

    // Where the light comes from: the irradiance, all of it, by surface.
    Eigen::VectorXd arrived = Eigen::VectorXd::Zero(3);
    double shares = 0;
    for (const viewer::Arrival& arrival : desk.facts->arrivals) {
      arrived += arrival.irradiance;
      shares += arrival.share;
    }
    EXPECT_LE((arrived - desk.facts->irradiance).norm(), 1e-6 * desk.facts->irradiance.norm());
    EXPECT_NEAR(shares, 1, 1e-12);
    viewer::show(desk, "arriving");
    const auto sent = viewer::shown_field(desk.session.known(), desk.look);
    ASSERT_TRUE(sent);
    const Eigen::Map<const Eigen::VectorXd> area(desk.session.model().mesh->area.data(),
                                                 transport.size());
    EXPECT_NEAR(sent->values.dot(area), arrived.mean(), 1e-9 * arrived.mean());

    viewer::show(desk, "form-factors");
    const auto field = viewer::shown_field(desk.session.known(), desk.look);
    ASSERT_TRUE(field);
    EXPECT_EQ(field->values, row);
  }
  EXPECT_THROW(desk.session.select(transport.size()), std::out_of_range);
  EXPECT_THROW(desk.session.select(-1), std::out_of_range);
}

// What the lamps contribute by the adjoint is what they contribute when they burn alone.
TEST(Session, LightPathsEqualSolvesOfSingleLamps) {
  viewer::Desk desk(coarse());
  open(desk.session, std::string(RADIOSITY_SCENES) + "/furnished-room.json");
  desk.asks_light_path = true;
  desk.session.select(11);
  viewer::update(desk);
  settle(desk.session);
  viewer::update(desk);
  ASSERT_NE(desk.session.light_path(), nullptr);
  ASSERT_EQ(desk.emitter_shares.size(), desk.session.mix().emitters.size());
  double shares = 0;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(3);
  for (const viewer::EmitterShare& share : desk.emitter_shares) {
    shares += share.share;
    sum += share.radiosity;
    viewer::LightMix alone = desk.session.mix();
    for (std::size_t e = 0; e < alone.emitters.size(); ++e) {
      alone.emitters[e].is_on = e == share.emitter;
    }
    const auto scene = viewer::mixed_scene(*desk.session.model().scene, alone);
    const auto single =
        solve(*desk.session.model().transport, exitance(scene, *desk.session.model().mesh),
              reflectance(scene, *desk.session.model().mesh), {.estimates_errors = false});
    const Eigen::VectorXd expected = single.radiosity.row(11);
    EXPECT_LE((share.radiosity - expected).norm(), 1e-6 * desk.facts->radiosity.norm());
  }
  EXPECT_NEAR(shares, 1, 1e-9);
  EXPECT_LE((sum - desk.facts->radiosity).norm(), 1e-6 * desk.facts->radiosity.norm());
}

TEST(Session, RecordsIterationsStepByStep) {
  viewer::Session session(coarse());
  open(session, kBox);
  for (const auto method : {radiosity::Method::jacobi, radiosity::Method::southwell,
                            radiosity::Method::conjugate_gradients}) {
    SCOPED_TRACE(radiosity::method_name(method));
    session.record_iteration(method);
    settle(session);
    const viewer::IterationRecord* record = session.iteration();
    ASSERT_NE(record, nullptr);
    EXPECT_TRUE(record->is_complete);
    ASSERT_GE(record->frames.size(), 3U);
    EXPECT_EQ(record->frames.front()->iteration, 0);
    const Eigen::MatrixXd first = record->frames.front()->radiosity.cast<double>();
    EXPECT_LE(difference(first, session.light()->solution.exitance), 1e-6);  // darkness
    const Eigen::MatrixXd last = record->frames.back()->radiosity.cast<double>();
    EXPECT_LE(difference(last, session.light()->solution.radiosity), 1e-5);
    EXPECT_LT(record->frames.back()->unshot_share, 1e-4);
    EXPECT_LT(record->bounds.back(), 1e-5);
  }
}

TEST(Session, KeepsWhatIsOpenIfTheNextFileIsBad) {
  viewer::Session session(coarse());
  open(session, kRoom);
  const auto mesh = session.model().mesh;
  open(session, std::string(RADIOSITY_SCENES) + "/README.md");
  EXPECT_EQ(session.model().mesh, mesh);
  EXPECT_NE(session.light(), nullptr);
  ASSERT_FALSE(session.messages().empty());
  EXPECT_TRUE(session.messages().back().is_error);
  EXPECT_NE(session.messages().back().text.find("README.md"), std::string::npos);
}

TEST(Session, StopsAndStartsAgain) {
  viewer::Session session({.patches = {.n_patches = 20000}});
  session.open(kBox);
  wait_until(session, [&] { return session.is_open(); });
  session.set_paused(true);
  session.stop();
  settle(session);
  EXPECT_EQ(session.model().transport, nullptr);
  session.restart(coarse());
  settle(session);
  EXPECT_LT(session.model().mesh->size(), 1000);
  EXPECT_EQ(session.light()->kind, Light::Kind::complete);
  session.restart({.patches = {.n_patches = 400, .adaptive = true}, .tolerance = 0.1});
  settle(session);
  EXPECT_EQ(session.light()->kind, Light::Kind::complete);
  EXPECT_EQ(session.light()->solution.radiosity.rows(), session.model().mesh->size());
}

}  // namespace
