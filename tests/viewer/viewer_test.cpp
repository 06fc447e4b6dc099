// The parts of the viewer that need no window.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <memory>
#include <random>
#include <thread>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "tests/support/output_folder.h"
#include "tests/support/wait_until.h"
#include "viewer/desk/camera_control.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/look.h"
#include "viewer/desk/patch_points.h"
#include "viewer/panels/recent_files.h"
#include "viewer/script/script.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/worker.h"

namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Scene;
using radiosity::Vec3;
using radiosity::test::wait_until;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

Scene scene_named(const std::string& name) {
  return io::read_scene(fs::path(RADIOSITY_SCENES) / name);
}

// Two lamps, one of them by its power, and three materials.
Scene furnished_room() { return scene_named("furnished-room.json"); }

TEST(LightMix, HasTheEmittingSurfaces) {
  const Scene scene = furnished_room();
  const viewer::LightMix mix = viewer::make_mix(scene);
  ASSERT_FALSE(mix.emitters.empty());
  for (const viewer::Emitter& emitter : mix.emitters) {
    for (const std::int32_t s : emitter.surfaces) {
      EXPECT_NE(scene.materials[scene.surfaces[s].material].emission.kind,
                radiosity::Emission::Kind::none);
    }
  }
}

TEST(LightMix, UnchangedMixIsTheScene) {
  const Scene scene = furnished_room();
  const PatchMesh mesh = meshing::make_patches(scene);
  const Scene mixed = viewer::mixed_scene(scene, viewer::make_mix(scene));
  EXPECT_EQ(radiosity::exitance(mixed, mesh), radiosity::exitance(scene, mesh));
  EXPECT_EQ(radiosity::reflectance(mixed, mesh), radiosity::reflectance(scene, mesh));
}

TEST(LightMix, EmittersAddUpToTheExitance) {
  for (const char* name : {"furnished-room.json", "cornell-box.json", "thermal-enclosure.json"}) {
    SCOPED_TRACE(name);
    const Scene scene = scene_named(name);
    const PatchMesh mesh = meshing::make_patches(scene);
    const viewer::LightMix mix = viewer::make_mix(scene);
    const Eigen::MatrixXd exitance = radiosity::exitance(scene, mesh);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(exitance.rows(), exitance.cols());
    for (const auto& emitter : mix.emitters) {
      sum += viewer::emitter_exitance(mesh, exitance, emitter);
    }
    EXPECT_EQ(sum, exitance);
  }
}

// What is saved must be what is shown, for every way to give an emission.
TEST(LightMix, MixedSceneEmitsTheFactorTimesAsMuch) {
  for (const char* name : {"furnished-room.json", "furnace-cube.json", "thermal-enclosure.json"}) {
    SCOPED_TRACE(name);
    const Scene scene = scene_named(name);
    const PatchMesh mesh = meshing::make_patches(scene);
    viewer::LightMix mix = viewer::make_mix(scene);
    mix.emitters.front().scale = 0.37;
    mix.emitters.back().is_on = mix.emitters.size() == 1;
    const Eigen::MatrixXd full = radiosity::exitance(scene, mesh);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(full.rows(), full.cols());
    for (const auto& emitter : mix.emitters) {
      expected += emitter.factor() * viewer::emitter_exitance(mesh, full, emitter);
    }
    const Eigen::MatrixXd found = radiosity::exitance(viewer::mixed_scene(scene, mix), mesh);
    EXPECT_LE((found - expected).norm(), 1e-13 * expected.norm());
  }
}

// What is off in the file can be switched on, and is as bright as its material says.
TEST(LightMix, LampsThatAreOffInTheFileCanBeSwitchedOn) {
  Scene scene = furnished_room();
  const PatchMesh mesh = meshing::make_patches(scene);
  const Eigen::MatrixXd full = radiosity::exitance(scene, mesh);
  const viewer::LightMix lit = viewer::make_mix(scene);
  scene.surfaces[lit.emitters.front().surfaces[0]].emission_factor = 0;
  scene.surfaces[lit.emitters.back().surfaces[0]].emission_factor = 0.4;
  viewer::LightMix mix = viewer::make_mix(scene);
  ASSERT_EQ(mix.emitters.size(), lit.emitters.size());
  EXPECT_FALSE(mix.emitters.front().is_on);
  EXPECT_EQ(mix.emitters.front().scale, 1);
  EXPECT_EQ(mix.emitters.back().factor(), 0.4);
  const Scene as_is = viewer::with_reflectance(scene, mix);
  EXPECT_LE((viewer::mix_exitance(as_is, mesh, mix) - radiosity::exitance(scene, mesh)).norm(),
            1e-13 * full.norm());
  mix.emitters.front().is_on = true;
  mix.emitters.back().scale = 1;
  EXPECT_LE((viewer::mix_exitance(as_is, mesh, mix) - full).norm(), 1e-13 * full.norm());
}

// Lamps of one material are taken together, but for those that are on otherwise.
TEST(LightMix, ManyLampsAreTakenTogetherIfTheyAreOnAlike) {
  Scene scene;
  scene.bands.kind = radiosity::Bands::Kind::grey;
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  scene.materials = {{"lamp", 0.5 * one, {radiosity::Emission::Kind::exitance, one}}};
  for (int s = 0; s < 60; ++s) {
    scene.surfaces.push_back({.name = "lamp " + std::to_string(s)});
    scene.surfaces.back().emission_factor = s < 10 ? 0 : s < 20 ? 0.5 : 1;
  }
  const viewer::LightMix mix = viewer::make_mix(scene);
  ASSERT_EQ(mix.emitters.size(), 3U);
  EXPECT_EQ(mix.emitters[0].name, "lamp (off)");
  EXPECT_FALSE(mix.emitters[0].is_on);
  EXPECT_EQ(mix.emitters[1].name, "lamp (50 %)");
  EXPECT_EQ(mix.emitters[1].scale, 0.5);
  EXPECT_EQ(mix.emitters[2].name, "lamp");
  EXPECT_EQ(mix.emitters[2].surfaces.size(), 40U);
}

TEST(LightMix, MeanReflectanceIsMetAndNoBandExceedsOne) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    Eigen::VectorXd original(1 + k % 5);
    for (double& value : original) value = k == 0 ? 0 : uniform(random);
    const double mean = k % 10 == 9 ? 1 : uniform(random);
    const Eigen::VectorXd changed = viewer::with_mean_reflectance(original, mean);
    EXPECT_LE(changed.maxCoeff(), 1);
    EXPECT_GE(changed.minCoeff(), 0);
    EXPECT_NEAR(changed.mean(), mean, 1e-12);
  }
}

TEST(LightMix, EmittersAreFoundByNameOrIndex) {
  viewer::LightMix mix;
  for (const char* name : {"lamp", "0", "7 up"}) mix.emitters.push_back({name, {}});
  EXPECT_EQ(viewer::emitter_named(mix, "lamp"), 0U);
  EXPECT_EQ(viewer::emitter_named(mix, "0"), 1U);  // a name counts first
  EXPECT_EQ(viewer::emitter_named(mix, "2"), 2U);
  EXPECT_FALSE(viewer::emitter_named(mix, "3"));
  EXPECT_FALSE(viewer::emitter_named(mix, "2x"));
  EXPECT_FALSE(viewer::emitter_named(mix, ""));
}

radiosity::Camera some_camera() {
  return {.position = Vec3(1, 2, 3), .direction = Vec3(-1, -2, -3).normalized(), .up = {0, 1, 0}};
}

TEST(CameraControl, OrbitKeepsPivotAndDistance) {
  const radiosity::Box3 box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  viewer::CameraControl control(some_camera(), box);
  const Vec3 pivot = control.pivot();
  const double distance = (control.camera().position - pivot).norm();
  EXPECT_LE(pivot.norm(), 1e-12);
  for (int k = 0; k < 50; ++k) {
    control.orbit(0.3, 0.2);
    EXPECT_LE((control.pivot() - pivot).norm(), 1e-12);
    EXPECT_NEAR((control.camera().position - pivot).norm(), distance, 1e-12);
    EXPECT_NEAR(control.camera().direction.norm(), 1, 1e-12);
    // It never looks along its up direction, where left and right would be undefined.
    EXPECT_GT(control.camera().direction.cross(control.camera().up).norm(), 1e-3);
  }
}

TEST(CameraControl, ZoomNeverReachesThePivot) {
  viewer::CameraControl control(some_camera(), {Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  for (int k = 0; k < 500; ++k) control.zoom(0.5);
  EXPECT_GT((control.camera().position - control.pivot()).norm(), 0);
  for (int k = 0; k < 100; ++k) control.zoom(2);
  EXPECT_TRUE(control.camera().position.allFinite());
}

TEST(CameraControl, PanMovesThePictureByThatShare) {
  viewer::CameraControl control(some_camera(), {Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  const Vec3 pivot = control.pivot();
  control.pan(0.25, 0);
  // The old pivot was in the middle; now it appears a quarter of the height to the left of it.
  const radiosity::Camera& camera = control.camera();
  const Vec3 expected = viewer::ray_direction(camera, 0.25, 0.5, 1);
  EXPECT_LE((expected - (pivot - camera.position).normalized()).norm(), 1e-9);
}

TEST(PatchPoints, KeepsConstantFieldsAndAveragesQuads) {
  const Scene scene = scene_named("cornell-box.json");
  const auto mesh = std::make_shared<PatchMesh>(meshing::make_patches(scene, {.n_patches = 400}));
  const viewer::PatchPoints points(mesh);
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(mesh->size(), 2, 0.7);
  for (const bool smooth : {true, false}) {
    const Eigen::MatrixXd values = points.values(constant, smooth);
    ASSERT_EQ(values.rows(), static_cast<Index>(points.positions().size()));
    EXPECT_TRUE((values.array() == 0.7).all());
  }
  double area = 0;
  for (const auto& t : points.triangles()) {
    const auto& p = points.positions();
    area += 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
  }
  double expected = 0;
  for (const double a : mesh->area) expected += a;
  EXPECT_NEAR(area, expected, 1e-12 * expected);
}

TEST(Look, EveryNameIsUnderstood) {
  for (const viewer::ShowName& name : viewer::show_names()) {
    viewer::Desk desk;
    viewer::show(desk, std::string(name.name));
    EXPECT_EQ(viewer::show_name(desk.look), name.name);
  }
  EXPECT_TRUE(viewer::show_named("true_color"));
  EXPECT_FALSE(viewer::show_named("colour of magic"));
  viewer::Desk desk;
  EXPECT_THROW(viewer::show(desk, "colour of magic"), std::invalid_argument);
}

TEST(Worker, DeliversWhatTasksPostAndTellsErrors) {
  viewer::Worker worker;
  int delivered = 0;
  worker.start([&](const viewer::Worker::Context& context) {
    context.post([&] { ++delivered; });
    throw radiosity::SceneError("no such thing");
  });
  while (worker.status().is_busy) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(worker.is_busy());  // something is still to be delivered
  EXPECT_TRUE(worker.deliver());
  EXPECT_EQ(delivered, 1);
  EXPECT_TRUE(worker.is_busy());  // so is what it has to say
  EXPECT_EQ(worker.take_error(), "no such thing");
  EXPECT_FALSE(worker.take_error());
  EXPECT_FALSE(worker.is_busy());
}

TEST(Worker, DropsWhatACancelledTaskPosted) {
  viewer::Worker worker;
  std::atomic<bool> has_posted = false;
  int first = 0;
  int second = 0;
  worker.start([&](const viewer::Worker::Context& context) {
    context.post([&] { ++first; });
    has_posted = true;
    while (true) {
      context.progress.check();
      std::this_thread::sleep_for(1ms);
    }
  });
  while (!has_posted) std::this_thread::sleep_for(1ms);
  worker.start([&](const viewer::Worker::Context& context) { context.post([&] { ++second; }); });
  while (worker.is_busy()) worker.deliver();
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 1);
  EXPECT_FALSE(worker.take_error());
}

TEST(Worker, IsNotBusyWithWhatACancelledTaskPosted) {
  viewer::Worker worker;
  std::atomic<bool> has_posted = false;
  worker.start([&](const viewer::Worker::Context& context) {
    context.post([] { FAIL() << "nobody waits for this"; });
    has_posted = true;
  });
  while (!has_posted) std::this_thread::sleep_for(1ms);
  worker.cancel();
  EXPECT_FALSE(worker.is_busy());
  EXPECT_FALSE(worker.deliver());
}

/// Counts to three, asking for leave before each, and tells where it is.
struct Counting {
  std::atomic<bool> has_begun = false;
  std::atomic<int> n_steps = 0;
  std::atomic<bool> has_ended = false;  ///< by itself or cancelled

  void run(const viewer::Worker::Context& context) {
    const std::shared_ptr<void> at_end(nullptr, [this](void*) { has_ended = true; });
    has_begun = true;
    for (int k = 0; k < 3; ++k) {
      context.progress.report("counting", k, 3, "steps");
      context.progress.check();
      ++n_steps;
    }
  }
};

/// Time for a thread that runs to do what it should not.
constexpr auto kTemptation = 50ms;

/// A worker that has begun to count while paused.
class PausedWorker : public testing::Test {
 protected:
  void SetUp() override {
    pause.set(true);
    worker.start([this](const viewer::Worker::Context& context) { counting.run(context); });
    ASSERT_TRUE(wait_until([&] { return counting.has_begun.load(); }));
    std::this_thread::sleep_for(kTemptation);  // until it waits, or goes on
  }

  Counting counting;
  viewer::Pause pause;
  viewer::Worker worker{&pause};
};

TEST_F(PausedWorker, Waits) {
  EXPECT_EQ(counting.n_steps, 0);
  pause.set(false);
  EXPECT_TRUE(wait_until([&] { return counting.has_ended.load(); }));
  EXPECT_EQ(counting.n_steps, 3);
}

TEST_F(PausedWorker, IsCancelled) {
  worker.cancel();
  EXPECT_FALSE(worker.is_busy());
  EXPECT_TRUE(wait_until([&] { return counting.has_ended.load(); }));
  EXPECT_EQ(counting.n_steps, 0);
  pause.set(false);  // or the worker would never end if this has failed
}

class Scripts : public OutputFolder {
 protected:
  std::string write(const std::string& text) const {
    std::ofstream(folder() / "script.json") << text;
    return (folder() / "script.json").string();
  }
  void expect_refused(const std::string& text, const std::string& words) const {
    try {
      const viewer::Script script(write(text));
      FAIL() << text << " was taken";
    } catch (const viewer::ScriptError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
};

TEST_F(Scripts, AllSpellingsOfAnActionAreTaken) {
  const viewer::Script script(write(R"([
    {"action": "set-quantity", "quantity": "illuminance", "log": true},
    {"set_quantity": "illuminance"}, {"set quantity": {"quantity": "area"}}, "fit",
    {"action": "wait_solved"}])"));
  EXPECT_FALSE(script.has_ended());
  EXPECT_TRUE(viewer::Script(write("[]")).has_ended());
  EXPECT_FALSE(viewer::Script(write(R"({"actions": ["fit"]})")).has_ended());
}

TEST_F(Scripts, BadOnesAreRefusedWithTheirPlace) {
  expect_refused("[", "script.json");
  expect_refused("{}", "list of actions");
  expect_refused("[3]", "action 0");
  expect_refused(R"(["fit", "jump"])", "action 1: no action is called 'jump'");
  expect_refused(R"([{"action": 3}])", "'action' must be a text");
  expect_refused(R"([{"load": "x", "scene": "y"}])", "action 0");
  EXPECT_THROW(viewer::Script((folder() / "none.json").string()), viewer::ScriptError);
}

class RecentFilesTest : public OutputFolder {};

TEST_F(RecentFilesTest, RemembersTheLatestFirst) {
  const fs::path list = folder() / "state" / "recent";
  {
    viewer::RecentFiles recent(list);
    for (int k = 0; k < 14; ++k) recent.add("/scenes/" + std::to_string(k) + ".json");
    recent.add("/scenes/9.json");
  }
  const viewer::RecentFiles recent(list);
  ASSERT_EQ(recent.paths().size(), 10U);
  EXPECT_EQ(recent.paths()[0], "/scenes/9.json");
  EXPECT_EQ(recent.paths()[1], "/scenes/13.json");
  EXPECT_EQ(std::count(recent.paths().begin(), recent.paths().end(), "/scenes/9.json"), 1);
}

TEST_F(RecentFilesTest, AFolderThatCannotBeWrittenIsNoError) {
  std::ofstream(folder() / "file") << "x";
  viewer::RecentFiles recent(folder() / "file" / "recent");
  recent.add("/scenes/a.json");
  EXPECT_EQ(recent.paths().size(), 1U);
}

}  // namespace
