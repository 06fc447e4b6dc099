/// Laws that hold for whole scenes, from the scene file to the solution.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "io/scene_file.h"
#include "meshing/patches.h"
#include "radiosity/radiosity.h"

namespace {

using namespace radiosity;

struct SolvedScene {
  Scene scene;
  PatchMesh mesh;
  std::unique_ptr<Visibility> visibility;
  std::unique_ptr<Transport> transport;
  Solution solution;
};

SolvedScene solve_scene(const std::string& name, const meshing::PatchOptions& patch_options,
                        double tolerance) {
  SolvedScene result;
  result.scene = io::read_scene(std::string(RADIOSITY_SCENES "/") + name);
  result.mesh = meshing::make_patches(result.scene, patch_options);
  result.visibility = std::make_unique<Visibility>(result.mesh);
  result.transport = make_transport(result.mesh, *result.visibility, {.tolerance = tolerance});
  result.solution = solve(*result.transport, exitance(result.scene, result.mesh),
                          reflectance(result.scene, result.mesh));
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
  const SolvedScene room = solve_scene("furnished-room.json", {}, 1e-2);
  ASSERT_TRUE(room.solution.converged);
  const EnergyBalance& energy = room.solution.energy;
  for (Index band = 0; band < energy.emitted.size(); ++band) {
    EXPECT_GT(energy.emitted[band], 0);
    // The bound is on ‖B‖ in the energy norm; powers of the same room are of its order.
    EXPECT_NEAR((energy.absorbed[band] + energy.escaped[band]) / energy.emitted[band], 1,
                100 * room.solution.error_bound + 1e-12);
  }
}

/// A unit vector about `normal` with density cosθ / π.
Vec3 cosine_direction(const Vec3& normal, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double azimuth = 2 * kPi * uniform(random);
  const double square = uniform(random);
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  return std::sqrt(square) * (std::cos(azimuth) * u + std::sin(azimuth) * v) +
         std::sqrt(1 - square) * normal;
}

TEST(FurnishedRoom, HemisphereFormAgreesWithAreaForm) {
  // The same irradiance by the rendering equation's other form: H = ∫ B(x') cosθ / π dω, with B
  // taken from the patch that a cosine-distributed ray meets.
  constexpr int kRays = 2000;
  const SolvedScene room = solve_scene("furnished-room.json", {}, 1e-2);
  const PatchMesh& mesh = room.mesh;
  const Eigen::MatrixXd& radiosity = room.solution.radiosity;
  const Eigen::MatrixXd area_error = room.transport->apply_error(radiosity);
  const Eigen::MatrixXd mean_square = room.transport->apply(radiosity.cwiseAbs2());
  std::mt19937_64 random(2024);
  std::uniform_real_distribution<double> uniform(0, 1);
  int n_checked = 0;
  int n_within_two = 0;
  for (Index i = 0; i < mesh.size(); i += 3) {
    double sum = 0;
    double squares = 0;
    for (int k = 0; k < kRays; ++k) {
      // Uniform on the patch: one of the quad's two triangles by area, then barycentric.
      const int n = mesh.n_corners(i);
      const Vec3& a = mesh.corner(i, 0);
      const auto half = [&](int c) {
        return (mesh.corner(i, c) - a).cross(mesh.corner(i, c + 1) - a).norm();
      };
      const bool is_second = n == 4 && uniform(random) * (half(1) + half(2)) > half(1);
      const int c = is_second ? 2 : 1;
      const double root = std::sqrt(uniform(random));
      const double v = uniform(random);
      const Vec3 origin =
          a + root * (1 - v) * (mesh.corner(i, c) - a) + root * v * (mesh.corner(i, c + 1) - a);
      const auto hit = room.visibility->first_hit(origin, cosine_direction(mesh.normal[i], random),
                                                  static_cast<std::int32_t>(i));
      const double value = hit && hit->front ? radiosity(hit->patch, 0) : 0;
      sum += value;
      squares += value * value;
    }
    const double mean = sum / kRays;
    // Rays seldom meet a small lamp, and a sample without it knows nothing of its variance: take
    // the area form's where that is larger.
    const double variance =
        std::max(squares / kRays - mean * mean,
                 mean_square(i, 0) - std::pow(room.solution.irradiance(i, 0), 2));
    const double error = std::hypot(std::sqrt(std::max(variance, 0.0) / kRays), area_error(i, 0));
    const double difference = std::abs(mean - room.solution.irradiance(i, 0));
    EXPECT_LE(difference, 5 * error + 1e-6 * mean) << "patch " << i;
    ++n_checked;
    n_within_two += difference <= 2 * error ? 1 : 0;
  }
  EXPECT_GE(n_within_two, 0.9 * n_checked);
}

TEST(Window, FactorThroughTheWindow) {
  // scenes/README.md: the factor through the window in closed form and quadrature, by mpmath.
  constexpr double kExpected = 0.10031860109940260;
  const SolvedScene window = solve_scene("window.json", {.max_edge = 0.2}, 1e-3);
  const PatchMesh& mesh = window.mesh;
  double power = 0;
  double variance = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] != 0) continue;
    const Eigen::VectorXd row = window.transport->row(i);
    const Eigen::VectorXd error = window.transport->row_error(i);
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
