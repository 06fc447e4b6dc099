// Many lights and reflectances with one set of form factors.
#include "study/scenarios.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"

namespace {

using namespace radiosity;

const study::StudyOptions kScenarioOptions{.patches = {.n_patches = 300}};

Scene scenario_room() { return io::read_scene(RADIOSITY_SCENES "/l-room.json"); }

/// Two that share a solve, two with walls of their own.
std::vector<Scenario> scenarios() {
  return {{"as is"},
          {"dark walls", {}, {{"*", Eigen::VectorXd::Constant(1, 0.2)}}},
          {"dimmed", {{"*", 0.25}}, {}},
          {"off", {{"*", 0}}, {{"*", Eigen::VectorXd::Constant(1, 0.3)}}}};
}

TEST(Scenarios, AreWhatTheyWouldBeOneByOne) {
  const std::vector<Scenario> list = scenarios();
  std::map<std::size_t, Solution> found;
  study::solve_scenarios(study::assemble(scenario_room(), kScenarioOptions), list, kScenarioOptions,
                         {}, [&](std::size_t k, const study::Study& solved) {
                           EXPECT_TRUE(found.emplace(k, solved.solution).second);
                         });
  ASSERT_EQ(found.size(), list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const study::Study alone = study::run(scene_of(scenario_room(), list[k]), kScenarioOptions);
    const Eigen::MatrixXd& expected = alone.solution.radiosity;
    ASSERT_EQ(found[k].radiosity.cols(), expected.cols());
    // Both are within the tolerance of the iteration.
    EXPECT_LE((found[k].radiosity - expected).norm(), 1e-7 * expected.norm()) << list[k].name;
    EXPECT_EQ(found[k].exitance, alone.solution.exitance);
    EXPECT_EQ(found[k].reflectance, alone.solution.reflectance);
    EXPECT_NEAR(found[k].energy.emitted[0], alone.solution.energy.emitted[0],
                1e-12 * alone.solution.energy.emitted[0]);
    EXPECT_EQ(found[k].radiosity_error.cols(), expected.cols());
  }
  EXPECT_TRUE(found[3].radiosity.isZero(0));
}

TEST(Scenarios, DimmedLightIsThatMuchLess) {
  std::map<std::size_t, Solution> found;
  study::solve_scenarios(
      study::assemble(scenario_room(), kScenarioOptions), scenarios(), kScenarioOptions, {},
      [&](std::size_t k, const study::Study& solved) { found[k] = solved.solution; });
  EXPECT_LE((4 * found[2].radiosity - found[0].radiosity).norm(), 1e-7 * found[0].radiosity.norm());
}

// Emissivities by temperature are settled for each, a shield's too; paint makes them constant.
TEST(Scenarios, SettleEmissivitiesByTemperature) {
  Scene scene = io::read_scene(RADIOSITY_SCENES "/furnace-walls.json");
  for (Material& material : scene.materials) {
    if (material.name != "load") material.emissivity_table = {{300, 0.2}, {1200, 0.9}};
  }
  const std::vector<Scenario> list = {{"as is"},
                                      {"half", {{"heater", 0.5}}, {}},
                                      {"painted", {}, {{"*", Eigen::VectorXd::Constant(1, 0.4)}}}};
  std::size_t n_visited = 0;
  study::solve_scenarios(
      study::assemble(scene, kScenarioOptions), list, kScenarioOptions, {},
      [&](std::size_t k, const study::Study& solved) {
        ++n_visited;
        const study::Study alone = study::run(scene_of(scene, list[k]), kScenarioOptions);
        const Eigen::VectorXd& expected = alone.solution.temperature;
        ASSERT_EQ(solved.solution.temperature.size(), expected.size());
        // Of the same solves; those of many columns end otherwise, within the iteration's error.
        EXPECT_LE((solved.solution.temperature - expected).norm(), 1e-6 * expected.norm())
            << list[k].name;
        EXPECT_EQ(solved.emissivity.has_value(), list[k].paints.empty());
      });
  EXPECT_EQ(n_visited, list.size());
}

TEST(Scenarios, LeaveTheStudyAsItWas) {
  const study::Study study =
      study::solve_scenarios(study::assemble(scenario_room(), kScenarioOptions), scenarios(),
                             kScenarioOptions, {}, [](std::size_t, const auto&) {});
  EXPECT_EQ(study.solution.radiosity.size(), 0);
  EXPECT_EQ(study.scene.materials.size(), scenario_room().materials.size());
}

TEST(Scenarios, AreCheckedBeforeAnyIsSolved) {
  int n_visited = 0;
  std::vector<Scenario> list = scenarios();
  list.push_back({"wrong", {{"nothing", 1}}, {}});
  EXPECT_THROW(
      study::solve_scenarios(study::assemble(scenario_room(), kScenarioOptions), list,
                             kScenarioOptions, {}, [&](std::size_t, const auto&) { ++n_visited; }),
      SceneError);
  EXPECT_EQ(n_visited, 0);
}

}  // namespace
