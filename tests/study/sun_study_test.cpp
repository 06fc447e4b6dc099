// Scenes with a sun, from the scene to its light.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/visibility/incident_light.h"
#include "study/scenarios.h"
#include "study/study.h"
#include "tests/support/scene_families.h"
#include "tests/support/scene_variations.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;

/// Of two unit squares at a right angle with a common edge: 1/π (2 atan 1 - √2 atan(1/√2) +
/// ln(3/4)/4), (Hamilton & Morgan 1952).
const double kCornerFactor =
    (2 * std::atan(1) - std::sqrt(2) * std::atan(1 / std::sqrt(2)) + std::log(0.75) / 4) / kPi;

/// A floor and a wall, unit squares with a common edge, in three bands.
Scene corner_scene(const Eigen::VectorXd& floor, const Eigen::VectorXd& wall) {
  Scene scene;
  scene.source = "corner";
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  scene.materials = {{"floor", floor, {}}, {"wall", wall, {}}};
  scene.surfaces = {{"floor", 0, false}, {"wall", 1, false}};
  scene.add_polygon(std::vector<std::int32_t>{0, 1, 2, 3}, 0);
  scene.add_polygon(std::vector<std::int32_t>{0, 3, 5, 4}, 1);
  return scene;
}

TEST(SunStudy, ReflectsTheSunToAndFro) {
  const Eigen::Vector3d floor(0.2, 0.5, 0.9);
  const Eigen::Vector3d wall(0.7, 0, 1);
  Scene scene = corner_scene(floor, wall);
  const Eigen::Vector3d sun(1000, 500, 3);
  scene.sun = Sun{.direction = Vec3(0, 0.6, -0.8), .irradiance = sun};  // along the wall
  const study::Study solved = study::run(scene, {.patches = {.as_is = true}, .tolerance = 1e-6});
  const double F = kCornerFactor;
  for (Index band = 0; band < 3; ++band) {
    const double direct = 0.8 * sun[band];
    const double floor_radiosity = floor[band] * direct / (1 - floor[band] * wall[band] * F * F);
    const auto near = [&](double value, double expected) {
      EXPECT_NEAR(value, expected, 1e-6 * direct) << "band " << band;
    };
    const Solution& solution = solved.solution;
    near(solution.incident(0, band), direct);
    EXPECT_EQ(solution.incident(1, band), 0);
    EXPECT_EQ(solution.exitance(0, band), 0);
    near(solution.radiosity(0, band), floor_radiosity);
    near(solution.irradiance(1, band), F * floor_radiosity);
    near(solution.irradiance(0, band), direct + F * wall[band] * F * floor_radiosity);
    near(solution.energy.incident[band], direct);
    near(solution.energy.absorbed[band] + solution.energy.escaped[band], direct);
    EXPECT_EQ(solution.energy.emitted[band], 0);
  }
}

Material grey_material(double emissivity, Emission emission) {
  return {.name = "m",
          .reflectance = Eigen::VectorXd::Constant(1, 1 - emissivity),
          .emission = std::move(emission)};
}

// Squares of 1 m² in one plane, which do not see each other, under a sun E and in surroundings
// S = σ 250⁴: what gives off no heat sends back all, σ T⁴ = E + S; a shield is at
// σ T⁴ = (ε (E + S) + ε' S) / (ε + ε').
TEST(SunStudy, ShinesWithSurroundingsOnWhatGivesOffHeat) {
  const auto of_one = [](Emission::Kind kind, double value) {
    return Emission{.kind = kind, .value = Eigen::VectorXd::Constant(1, value)};
  };
  Scene scene;
  scene.source = "plates";
  scene.bands.kind = Bands::Kind::grey;
  scene.materials = {grey_material(0.3, of_one(Emission::Kind::heat_flux, 0)),
                     grey_material(0.5, of_one(Emission::Kind::temperature, 300)),
                     grey_material(0.9, {}), grey_material(0.2, {})};
  scene.surfaces = {{"adiabatic", 0, false}, {"warm", 1, false}, {"shield", 2, true}};
  scene.surfaces[2].back_material = 3;
  scene.surfaces[2].is_shield = true;
  for (int s = 0; s < 3; ++s) {
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) {
      scene.vertices.push_back(p + Vec3(2 * s, 0, 0));
    }
    scene.add_polygon(std::vector<std::int32_t>{4 * s, 4 * s + 1, 4 * s + 2, 4 * s + 3}, s);
  }
  scene.environment = of_one(Emission::Kind::temperature, 250);
  scene.sun =
      Sun{.direction = Vec3(0, 0.6, -0.8), .irradiance = Eigen::VectorXd::Constant(1, 1000)};
  const study::Study solved = study::run(scene, {.patches = {.as_is = true}, .tolerance = 1e-6});
  const double sun = 800;
  const double dark = kStefanBoltzmann * std::pow(250, 4);
  const double warm = kStefanBoltzmann * std::pow(300, 4);
  const double expected[] = {sun + dark, warm, (0.9 * (sun + dark) + 0.2 * dark) / 1.1};
  const Solution& solution = solved.solution;
  ASSERT_EQ(solution.temperature.size(), 4);
  for (Index i = 0; i < 4; ++i) {
    const double black = kStefanBoltzmann * std::pow(solution.temperature[i], 4);
    // The bound of the iteration is 1e-9 of B, and σ T⁴ = (B - (1 - ε) H) / ε with ε >= 0.2.
    EXPECT_NEAR(black, expected[solved.mesh.surface[i]], 1e-7 * (sun + dark)) << i;
  }
  EXPECT_NEAR(solution.energy.incident[0], 3 * sun + 4 * dark, 1e-9 * sun);
  EXPECT_NEAR(solution.energy.absorbed[0], 0.5 * (sun + dark), 1e-6 * sun);
  EXPECT_NEAR(solution.energy.emitted[0], 0.5 * warm, 1e-9 * warm);
  EXPECT_NEAR(solution.energy.escaped[0], 3 * sun + 4 * dark + 0.5 * warm - 0.5 * (sun + dark),
              1e-6 * sun);
}

TEST(SunStudy, BalancesItsPowerInAllKindsOfScenes) {
  int k = 0;
  for (const test::Family family : test::kFamilies) {
    test::Variation variation = {.is_turned = k % 2 == 1, .scale = k % 3 == 0 ? 30. : 1.};
    if (k % 4 == 0) variation.digits = test::Digits::six;
    variation.seed = 11;
    Scene scene = test::vary(test::make_family_scene(family, 3), variation).scene;
    std::mt19937_64 random(100 + k++);
    for (Material& material : scene.materials) {
      material.reflectance = Eigen::VectorXd::Constant(scene.bands.count(), 0.6);
    }
    scene.sun = Sun{.direction = test::random_unit(random),
                    .irradiance = Eigen::VectorXd::Constant(scene.bands.count(), 1367)};
    const study::Study solved = study::run(scene, {.patches = {.n_patches = 50}});
    const EnergyBalance& energy = solved.solution.energy;
    const Eigen::VectorXd given = energy.emitted + energy.incident;
    // The iteration's residual is 1e-6 of the sources at most, in the energy norm.
    EXPECT_LE((energy.absorbed + energy.escaped - given).cwiseAbs().maxCoeff(),
              1e-4 * given.maxCoeff())
        << test::family_name(family);
    const Eigen::Map<const Eigen::VectorXd> area(solved.mesh.area.data(), solved.mesh.size());
    EXPECT_TRUE(energy.incident.isApprox(solved.solution.incident.transpose() * area, 1e-12));
    const Solution& s = solved.solution;
    EXPECT_TRUE(s.radiosity.isApprox(s.exitance + s.reflectance.cwiseProduct(s.irradiance), 1e-5));
  }
}

TEST(SunStudy, IsInEachScenario) {
  Scene scene = corner_scene(Eigen::Vector3d::Constant(0.5), Eigen::Vector3d::Constant(0.5));
  scene.materials[1].emission = {Emission::Kind::exitance, Eigen::Vector3d(1, 2, 3)};
  scene.sun = Sun{.direction = Vec3(-0.6, 0, -0.8), .irradiance = Eigen::Vector3d(10, 20, 30)};
  const study::StudyOptions options = {.patches = {.n_patches = 30}};
  const std::vector<Scenario> scenarios = {
      {.name = "day", .lights = {{"wall", 0}}},
      {.name = "both"},
      {.name = "dark", .paints = {{"*", Eigen::VectorXd::Zero(1)}}}};
  std::vector<Solution> found(scenarios.size());
  study::solve_scenarios(
      study::assemble(scene, options), scenarios, options, {},
      [&](std::size_t k, const study::Study& solved) { found[k] = solved.solution; });
  for (std::size_t k = 0; k < scenarios.size(); ++k) {
    const study::Study alone = study::run(scene_of(scene, scenarios[k]), options);
    EXPECT_TRUE(found[k].irradiance.isApprox(alone.solution.irradiance, 1e-5)) << k;
    EXPECT_EQ(found[k].incident, alone.solution.incident);
    EXPECT_TRUE(found[k].energy.incident.isApprox(alone.solution.energy.incident, 1e-12));
  }
}

TEST(SunStudy, WarnsOfASunThatReachesNothing) {
  Scene scene = corner_scene(Eigen::Vector3d::Constant(0.5), Eigen::Vector3d::Constant(0.5));
  scene.sun = Sun{.direction = Vec3(0, 0, 1), .irradiance = Eigen::Vector3d::Ones()};
  std::vector<std::string> warnings;
  study::run(scene, {}, {.warned = [&](const std::string& text) { warnings.push_back(text); }});
  ASSERT_GE(warnings.size(), 2U);
  EXPECT_EQ(warnings[0], "no light of sun or luminaires reaches a surface's emitting side");
}

TEST(SunStudy, HasTheSameBitsAtAnyNumberOfThreads) {
  Scene scene = test::make_family_scene(test::Family::windows, 4).scene;
  scene.sun = Sun{.direction = Vec3(0.3, 0.5, -0.6).normalized(),
                  .irradiance = Eigen::VectorXd::Ones(scene.bands.count())};
  std::vector<Eigen::MatrixXd> found;
  for (const std::size_t n : {1, 3}) {
    const ThreadLimit threads(n);
    found.push_back(study::run(scene, {.patches = {.n_patches = 200}}).solution.radiosity);
  }
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
