#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/scene/neighbor_groups.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/uneven_light.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/hung_boxes.h"
#include "tests/support/matrix_transport.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

Solution solve_patches(const Scene& scene, const PatchMesh& mesh) {
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::yes});
  const Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  return with_discretisation_error(solution, discretisation_error(mesh, *transport, solution));
}

class HungBoxes : public ::testing::TestWithParam<std::uint64_t> {};

// Rooms in which 59 to 83 % were within while the errors came from coarser patches only.
INSTANTIATE_TEST_SUITE_P(ErrorBars, HungBoxes, ::testing::Values(30, 34, 36));

TEST_P(HungBoxes, FinerPatchesAreWithinTwoStandardErrors) {
  const Scene scene = test::make_hung_boxes(GetParam());
  const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = 130});
  const Solution solution = solve_patches(scene, mesh);
  const PatchMesh finer = test::divided_into_four(mesh);
  const Eigen::MatrixXd truth = test::means_of_four(finer, solve_patches(scene, finer).radiosity);
  const test::IntervalCheck check = test::check_intervals(solution, truth);
  EXPECT_GE(check.n_within, 0.95 * static_cast<double>(mesh.size()));
  // 3 if errors are normal; twice that, as the finer patches have half the error at order 1, and
  // twice that for a guess that is good to a factor.
  EXPECT_LE(check.interval, 12 * check.error);
}

/// A patch with a lamp in contact with its half: the lamp gets back more than from an evenly lit
/// patch.
TEST(UnevenLight, IsRightForAHalfCoveredPatch) {
  PatchMesh mesh;
  test::add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  test::add_grid(mesh, Vec3(0.5, 0, 1e-6), Vec3::UnitY(), Vec3::UnitX(), 1, 1);
  const double rho = 1e-3;
  const double factor = 0.5;
  Eigen::Matrix2d exchange;
  exchange << 0, factor, factor, 0;
  const test::DenseTestTransport transport(exchange, Eigen::Vector2d::Ones());
  const Solution solution = solve(transport, Eigen::Vector2d(0, 1), Eigen::Vector2d::Constant(rho));
  const Eigen::MatrixXd error =
      uneven_light_error(mesh, transport, solution, make_neighbor_groups(mesh));
  // The covered half has ρ, the other half nothing; the emitter sees the covered half alone.
  const double evenly_lit = rho * factor * (rho * factor);
  const double true_light = rho * factor * rho;
  EXPECT_NEAR(error(1, 0), true_light - evenly_lit, 10 * rho * true_light);
}

TEST(UnevenLight, ScalesWithLightAndNotWithLengths) {
  const Scene scene = test::make_hung_boxes(2);
  const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = 130});
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  const Eigen::MatrixXd light = exitance(scene, mesh);
  const Eigen::MatrixXd rho = reflectance(scene, mesh);
  const Eigen::MatrixXd error = uneven_light_error(mesh, *transport, solve(*transport, light, rho),
                                                   make_neighbor_groups(mesh));
  EXPECT_GT(error.minCoeff(), 0);
  // Powers of two change no digit; what is left is the solution's own tolerance.
  Eigen::MatrixXd two_bands(mesh.size(), 2);
  two_bands << light, 8 * light;
  const Solution brighter = solve(*transport, two_bands, rho);
  const Eigen::MatrixXd errors =
      uneven_light_error(mesh, *transport, brighter, make_neighbor_groups(mesh));
  EXPECT_LE((errors.col(1) - 8 * errors.col(0)).cwiseAbs().maxCoeff(),
            1e-6 * errors.col(1).maxCoeff());
  EXPECT_LE((errors.col(0) - error.col(0)).cwiseAbs().maxCoeff(), 1e-2 * error.maxCoeff());

  PatchMesh larger = mesh;
  for (Vec3& vertex : larger.vertices) vertex *= 4;
  for (Index i = 0; i < mesh.size(); ++i) {
    larger.area[i] *= 16;
    larger.centroid[i] *= 4;
  }
  EXPECT_EQ(uneven_light_error(larger, *transport, brighter, make_neighbor_groups(larger)), errors);
}

}  // namespace
}  // namespace radiosity
