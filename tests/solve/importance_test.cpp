#include "radiosity/solve/importance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <string>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/direct_solve.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {
using test::DenseTestTransport;
using test::energy_norm;
using test::random_matrix;

constexpr std::uint64_t kImportanceSeed = 20250313;
constexpr double kImportanceTolerance = 1e-8;
constexpr double kImportanceRounding = 1e-12;

/// Energy norms of the adjoint solutions X, whose relative error is at most kImportanceTolerance.
double adjoint_norm(const DenseTestTransport& transport, const Eigen::VectorXd& rho, Index patch) {
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(transport.size(), 1);
  exitance(patch) = rho[patch] / transport.area()[patch];
  return energy_norm(transport.area(),
                     test::solve_directly(transport.form_factors(), exitance, rho).col(0));
}

TEST(Importance, IsARowOfTheInverse) {
  std::mt19937_64 random(kImportanceSeed);
  for (int trial = 0; trial < 6; ++trial) {
    const DenseTestTransport transport =
        trial % 2 == 0 ? test::random_open(25, random) : test::random_closed(25, random);
    Eigen::MatrixXd reflectance = random_matrix(25, 2, -0.2, 0.95, random).cwiseMax(0);
    reflectance(4, 0) = 0;
    for (const Index patch : {Index{0}, Index{4}, Index{24}}) {
      const Eigen::MatrixXd y = importance(transport, reflectance, patch,
                                           {.tolerance = kImportanceTolerance, .on_step = {}});
      ASSERT_EQ(y.rows(), 25);
      ASSERT_EQ(y.cols(), 2);
      EXPECT_GE(y.minCoeff(), 0);
      for (Index c = 0; c < 2; ++c) {
        const Eigen::MatrixXd rho = reflectance.col(c).asDiagonal();
        const Eigen::MatrixXd inverse =
            (Eigen::MatrixXd::Identity(25, 25) - rho * transport.form_factors()).inverse();
        // A^½ F ΔX is what is wrong, and ‖F̂‖ <= 1.
        const Eigen::VectorXd error = transport.area().cwiseSqrt().cwiseInverse().cwiseProduct(
            y.col(c) - inverse.row(patch).transpose());
        EXPECT_LE(error.norm(),
                  kImportanceTolerance * adjoint_norm(transport, reflectance.col(c), patch) +
                      kImportanceRounding);
      }
    }
  }
}

TEST(Importance, OfABlackPatchIsItsOwnLight) {
  std::mt19937_64 random(kImportanceSeed);
  const DenseTestTransport transport = test::random_closed(10, random);
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(10, 1, 0.5);
  reflectance(3) = 0;
  EXPECT_EQ(importance(transport, reflectance, 3), Eigen::VectorXd::Unit(10, 3));
}

TEST(Importance, IsReciprocal) {
  std::mt19937_64 random(kImportanceSeed);
  const DenseTestTransport transport = test::random_closed(12, random);
  const Eigen::MatrixXd rho = random_matrix(12, 1, 0.1, 0.9, random);
  const Eigen::MatrixXd to_2 = importance(transport, rho, 2);
  const Eigen::MatrixXd to_7 = importance(transport, rho, 7);
  // (I - ρ F)^-1 ρ A^-1 is symmetric.
  EXPECT_NEAR(to_2(7) * rho(7) / transport.area()[7], to_7(2) * rho(2) / transport.area()[2],
              1e-6 * to_2(7));
}

TEST(Importance, WeighsTheLightsOfARoom) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = 300});
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 0.05});
  const Eigen::MatrixXd emitted = exitance(scene, mesh);
  const Eigen::MatrixXd rho = reflectance(scene, mesh);
  const Solution solution =
      solve(*transport, emitted, rho, {.tolerance = kImportanceTolerance, .on_step = {}});
  const Eigen::VectorXd& area = transport->area();
  for (Index patch = 0; patch < mesh.size(); patch += 37) {
    const Eigen::MatrixXd y =
        importance(*transport, rho, patch, {.tolerance = kImportanceTolerance, .on_step = {}});
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(mesh.size(), 3);
    own.row(patch) = rho.row(patch) / area[patch];
    const Solution adjoint = solve(*transport, own, rho);
    for (Index c = 0; c < 3; ++c) {
      // <M, F ΔX> <= ‖M‖ ‖ΔX‖ and the solution's own bound.
      const double allowed =
          kImportanceTolerance *
          (energy_norm(area, emitted.col(c)) * energy_norm(area, adjoint.radiosity.col(c)) +
           energy_norm(area, solution.radiosity.col(c)) / std::sqrt(area[patch]));
      EXPECT_NEAR(y.col(c).dot(emitted.col(c)), solution.radiosity(patch, c), allowed);
      EXPECT_LE(allowed, 2e-4 * solution.radiosity(patch, c));  // else nothing is shown
    }
  }
}

TEST(Importance, KnowsItsPatches) {
  std::mt19937_64 random(kImportanceSeed);
  const DenseTestTransport transport = test::random_closed(10, random);
  const Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(10, 1, 0.5);
  for (const Index patch : {Index{-1}, Index{10}}) {
    EXPECT_THROW(importance(transport, reflectance, patch), SolveError);
  }
  EXPECT_THROW(importance(transport, reflectance.topRows(9), 2), SolveError);
  try {
    importance(transport, reflectance, 10);
  } catch (const SolveError& error) {
    EXPECT_STREQ(error.what(),
                 "there is no patch 10; expected one of the 10 patches, counted from 0");
  }
}

}  // namespace
}  // namespace radiosity
