#include "radiosity/exchange/sampled_destinations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;

/// Beyond so many standard errors of sixteen means a right value is once in 10,000 times.
constexpr double kSigmas = 5.5;
constexpr double kRowRounding = 1e-12;

/// A room without its far wall, in it a box, a one-sided plate that faces up, and a two-sided one.
PatchMesh make_room(int n) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), n, n);  // floor
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), n, n);  // ceiling
  add_grid(mesh, Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), n, n);  // wall y = 0
  add_box(mesh, Vec3(0.2, 0.2, 0.1), Vec3(0.5, 0.4, 0.5), n, Facing::outwards);
  add_grid(mesh, Vec3(0.3, 0.5, 0.6), Vec3(0.5, 0, 0), Vec3(0, 0.3, 0), n, n);
  const auto plate = add_grid(mesh, Vec3(0.7, 0.2, 0.2), Vec3(0, 0.3, 0), Vec3(0, 0, 0.4), n, n);
  test::make_two_sided(mesh, plate);
  return mesh;
}

TEST(SampledDestinations, OpposedSquares) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  const DestinationEstimate estimate = sampled_destinations(mesh, 0);
  EXPECT_GT(estimate.error.sky, 0);
  EXPECT_LT(estimate.error.sky, 1e-3);
  EXPECT_NEAR(estimate.value.surfaces[1], 0.199824895698387383,
              kSigmas * estimate.error.surfaces[1]);
  EXPECT_NEAR(estimate.value.sum(), 1, kRowRounding);
}

TEST(SampledDestinations, ClosedRoomIsCertain) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 1, Facing::inwards);
  const DestinationEstimate estimate = sampled_destinations(mesh, 3, {.n_points = 64});
  EXPECT_NEAR(estimate.value.sky, 0, kRowRounding);
  EXPECT_NEAR(estimate.error.sky, 0, kRowRounding);
  EXPECT_NEAR(estimate.value.backs, 0, kRowRounding);
}

TEST(SampledDestinations, AgreeWithTheFormFactorsOfAllPairs) {
  const PatchMesh polygons = make_room(1);
  const PatchMesh patches = make_room(4);
  const Visibility visibility(patches);
  const auto transport =
      make_transport(patches, visibility, {.tolerance = 1e-3, .closed = Closed::no});
  const Eigen::MatrixXd factors = surface_form_factors(patches, *transport);
  const Eigen::MatrixXd errors = surface_form_factor_errors(patches, *transport);
  for (std::int32_t s = 0; s < factors.rows(); ++s) {
    const DestinationEstimate estimate = sampled_destinations(polygons, s, {.n_points = 256});
    EXPECT_NEAR(estimate.value.sum(), 1, kRowRounding);
    double variance = 0;
    for (Index t = 0; t < factors.cols(); ++t) {
      const double sigma = std::hypot(errors(s, t), estimate.error.surfaces[t]);
      EXPECT_NEAR(estimate.value.surfaces[t], factors(s, t), kSigmas * sigma + 1e-8)
          << s << " to " << t;
      variance += errors(s, t) * errors(s, t);
    }
    const double unseen = 1 - factors.row(s).sum();
    const double sigma = std::sqrt(variance) + estimate.error.sky + estimate.error.backs;
    EXPECT_NEAR(estimate.value.sky + estimate.value.backs, unseen, kSigmas * sigma + 1e-8) << s;
  }
}

TEST(SampledDestinations, SeedsDifferWithinTheErrors) {
  const PatchMesh mesh = make_room(1);
  const DestinationEstimate one = sampled_destinations(mesh, 0, {.n_points = 256, .seed = 1});
  const DestinationEstimate two = sampled_destinations(mesh, 0, {.n_points = 256, .seed = 2});
  EXPECT_NE(one.value.backs, two.value.backs);
  EXPECT_GT(one.value.backs, 0);
  EXPECT_NEAR(one.value.backs, two.value.backs,
              kSigmas * std::hypot(one.error.backs, two.error.backs));
  const ThreadLimit limit(1);
  EXPECT_EQ(sampled_destinations(mesh, 0, {.n_points = 256, .seed = 1}).value.surfaces,
            one.value.surfaces);
}

TEST(SampledDestinations, TwoSidedSurfacesLookBothWays) {
  PatchMesh mesh;
  test::make_two_sided(mesh, add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1));
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  add_grid(mesh, Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  const DestinationEstimate estimate = sampled_destinations(mesh, 0);
  for (const Index other : {1, 2}) {
    EXPECT_NEAR(estimate.value.surfaces[other], 0.199824895698387383 / 2,
                kSigmas * estimate.error.surfaces[other]);
  }
}

}  // namespace
}  // namespace radiosity
