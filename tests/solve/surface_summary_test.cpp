// What surfaces receive and lose as wholes.
#include <gtest/gtest.h>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/quantity_summary.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/surface_flux.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;

/// A box of six surfaces with 3 x 3 patches each, lit at random.
struct LitBox {
  PatchMesh mesh;
  Solution solution;

  LitBox() {
    test::add_box(mesh, Vec3::Zero(), Vec3(1, 2, 3), 3, test::Facing::inwards);
    std::srand(1);  // Eigen's
    const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(mesh.size(), 2);
    solution.radiosity = ones + Eigen::MatrixXd::Random(mesh.size(), 2);
    solution.irradiance = ones + Eigen::MatrixXd::Random(mesh.size(), 2);
  }
};

TEST(SurfaceFlux, AddsUpToWhatAllPatchesLose) {
  const LitBox box;
  const Eigen::Map<const Eigen::VectorXd> area(box.mesh.area.data(), box.mesh.size());
  double heat = 0;
  double all = 0;
  const std::vector<SurfaceFlux> fluxes = surface_fluxes(box.mesh, box.solution);
  ASSERT_EQ(fluxes.size(), box.mesh.surface_names.size());
  for (const SurfaceFlux& flux : fluxes) {
    EXPECT_NEAR(flux.heat, flux.area * flux.flux, 1e-12);
    heat += flux.heat;
    all += flux.area;
  }
  EXPECT_NEAR(all, 22, 1e-12);
  const Eigen::MatrixXd net = box.solution.radiosity - box.solution.irradiance;
  EXPECT_NEAR(heat, (area.transpose() * net).sum(), 1e-12 * all);
}

TEST(QuantitySummary, MeansAreBetweenExtremesAndMakeUpTheWhole) {
  const LitBox box;
  const QuantitySummary summary =
      summarize({quantity_info(Quantity::irradiance), "W/m²", box.solution.irradiance}, box.mesh);
  ASSERT_EQ(summary.surfaces.size(), box.mesh.surface_names.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2);
  Eigen::VectorXd power = Eigen::VectorXd::Zero(2);
  for (const QuantityShare& share : summary.surfaces) {
    EXPECT_TRUE((share.least.array() <= share.mean.array()).all());
    EXPECT_TRUE((share.mean.array() <= share.greatest.array()).all());
    sum += share.sum;
    power += share.area * share.mean;
  }
  EXPECT_TRUE(sum.isApprox(summary.total.sum, 1e-13));
  EXPECT_TRUE(power.isApprox(summary.total.area * summary.total.mean, 1e-13));
  EXPECT_EQ(summary.total.greatest, box.solution.irradiance.colwise().maxCoeff().transpose());
}

}  // namespace
