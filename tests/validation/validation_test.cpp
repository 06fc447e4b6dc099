/// Laws that hold for whole scenes, from the scene file to the solution.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "apps/validation/reference/hemisphere.h"
#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/radiosity.h"

namespace {

using namespace radiosity;

study::Study solve_scene(const std::string& name, const meshing::PatchChoice& patches,
                         double tolerance) {
  study::Study result = study::assemble(io::read_scene(std::string(RADIOSITY_SCENES "/") + name),
                                        {.patches = patches, .tolerance = tolerance});
  result.solution = apps::validation::solve_own_light(result);
  return result;
}

TEST(Furnace, RadiosityIsExitanceOverAbsorptance) {
  // In a closed room of uniform reflectance ρ and exitance M, B = M / (1 - ρ) everywhere.
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/furnace-cube.json");
  for (const double max_edge : {1.0, 0.1}) {
    const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = max_edge});
    const Visibility visibility(mesh);
    const auto transport = make_transport(mesh, visibility);
    const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(mesh.size(), 1);
    for (const double rho : {0.0, 0.5, 0.9, 0.99}) {
      const Solution solution = solve(*transport, ones, rho * ones);
      EXPECT_TRUE(solution.converged);
      EXPECT_LT((solution.radiosity.array() * (1 - rho) - 1).abs().maxCoeff(), 1e-6)
          << "reflectance " << rho << ", edge " << max_edge;
    }
  }
}

TEST(Furnace, ConjugateGradientsTakeFewProducts) {
  // One face of the closed cube emits; the goal for a guaranteed error of 1e-8 is 45 products.
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/furnace-cube.json");
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 0.1});
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility);
  Eigen::MatrixXd emission = Eigen::MatrixXd::Zero(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) emission(i, 0) = mesh.polygon[i] == 0 ? 1 : 0;
  const Solution solution =
      solve(*transport, emission, Eigen::MatrixXd::Constant(mesh.size(), 1, 0.95));
  EXPECT_TRUE(solution.converged);
  EXPECT_LE(solution.products, 45);
  EXPECT_NEAR(solution.energy.absorbed[0], solution.energy.emitted[0], 1e-6);
}

TEST(FurnishedRoom, EnergyIsBalanced) {
  const study::Study room = solve_scene("furnished-room.json", {.as_is = true}, 1e-2);
  ASSERT_TRUE(room.solution.converged);
  const EnergyBalance& energy = room.solution.energy;
  for (Index band = 0; band < energy.emitted.size(); ++band) {
    EXPECT_GT(energy.emitted[band], 0);
    // What is missing is Σ A r, r = M_e + ρ F B - B, and |Σ A r| <= √(Σ A) ‖r‖ in the energy norm;
    // beside that the rounding of sums of n terms, Σ A B in all.
    const Eigen::VectorXd area = apps::validation::areas(room.mesh);
    const double emitted_norm = std::sqrt(area.dot(room.solution.exitance.col(band).cwiseAbs2()));
    const double rounding =
        static_cast<double>(area.size()) * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(energy.absorbed[band] + energy.escaped[band], energy.emitted[band],
                std::sqrt(area.sum()) * room.solution.residual * emitted_norm +
                    rounding * area.dot(room.solution.radiosity.col(band)));
  }
}

TEST(FurnishedRoom, HemisphereFormAgreesWithAreaForm) {
  // The same irradiance by the rendering equation's other form: H = ∫ B(x') cosθ / π dω, with B
  // taken from the patch that a cosine-distributed ray meets.
  const study::Study room = solve_scene("furnished-room.json", {.as_is = true}, 1e-2);
  int n_within_two = 0;
  const auto all = apps::validation::compare_irradiance(room, room.solution, {.seed = 2024});
  for (const auto& [by_rays, by_area, error] : all) {
    const double difference = std::abs(by_rays - by_area);
    EXPECT_LE(difference, 5 * error + 1e-6 * by_rays);
    n_within_two += difference <= 2 * error ? 1 : 0;
  }
  EXPECT_GE(n_within_two, 0.9 * static_cast<double>(all.size()));
}

TEST(Window, FactorThroughTheWindow) {
  // scenes/README.md: the factor through the window in closed form and quadrature, by mpmath.
  constexpr double kExpected = 0.10031860109940260;
  const study::Study window = solve_scene("window.json", {.max_edge = 0.2}, 1e-3);
  const PatchMesh& mesh = window.mesh;
  double power = 0;
  double variance = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] != 0) continue;
    const Eigen::VectorXd row = rows_of(*window.transport).row(i);
    const Eigen::VectorXd error = rows_of(*window.transport).row_error(i);
    for (Index j = 0; j < mesh.size(); ++j) {
      if (mesh.surface[j] != 1) continue;
      power += mesh.area[i] * row[j];
      variance += std::pow(mesh.area[i] * error[j], 2);
    }
  }
  EXPECT_GT(variance, 0);
  EXPECT_NEAR(power, kExpected, 4 * std::sqrt(variance));
}

}  // namespace
