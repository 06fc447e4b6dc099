#include "radiosity/exchange/point_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stop_token>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;
using test::random_unit;

constexpr std::uint64_t kPointSeed = 4711;
/// Some hundred pieces, each with a few roundings of 1.1e-16.
constexpr double kPointRounding = 1e-13;

/// Factor from an element to a parallel rectangle a x b at distance c, one corner on the normal.
double corner_factor(double a, double b, double c) {
  const double x = a / c;
  const double y = b / c;
  const double p = std::sqrt(1 + x * x);
  const double q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi);
}

/// The same to a square of the given side whose centre is on the normal.
double square_factor(double side, double distance) {
  return 4 * corner_factor(side / 2, side / 2, distance);
}

/// A square about the z axis that faces down.
std::int32_t add_ceiling(PatchMesh& mesh, double side, double z, int n = 1) {
  return add_grid(mesh, Vec3(-side / 2, -side / 2, z), Vec3(0, side, 0), Vec3(side, 0, 0), n, n);
}

/// The same facing up.
std::int32_t add_floor(PatchMesh& mesh, double side, double z, int n = 1) {
  return add_grid(mesh, Vec3(-side / 2, -side / 2, z), Vec3(side, 0, 0), Vec3(0, side, 0), n, n);
}

Destinations from_origin(const PatchMesh& mesh) {
  return point_factors(mesh, Vec3::Zero(), Vec3::UnitZ());
}

/// Triangles of all sizes anywhere in the unit cube, many crossing; every third two-sided.
PatchMesh random_scene(std::mt19937_64& random, int n_patches) {
  std::uniform_real_distribution<double> uniform(0, 1);
  PatchMesh mesh;
  for (int i = 0; i < n_patches; ++i) {
    const Vec3 center(uniform(random), uniform(random), uniform(random));
    const double size = 2 * std::pow(n_patches, -0.5 * uniform(random));
    const Vec3 u = size * random_unit(random);
    const auto surface = add_grid(mesh, center, u, size * u.unitOrthogonal(), 1, 1);
    if (i % 3 == 0) test::make_two_sided(mesh, surface);
  }
  return mesh;
}

TEST(PointFactors, RectangleWithCornerOnTheNormal) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  const Destinations shares = from_origin(mesh);
  // tests/data/form-factors.json: differential element to parallel rectangle.
  EXPECT_NEAR(shares.surfaces[0], 0.138531605994892997, 1e-15);
  EXPECT_NEAR(shares.sky, 1 - 0.138531605994892997, kPointRounding);
  EXPECT_EQ(shares.backs, 0);
}

TEST(PointFactors, DivisionDoesNotMatter) {
  PatchMesh mesh;
  add_ceiling(mesh, 3, 1, 40);  // 1600 patches
  EXPECT_NEAR(from_origin(mesh).surfaces[0], square_factor(3, 1), 1e-12);
}

TEST(PointFactors, NothingToSeeIsSky) {
  EXPECT_NEAR(from_origin(PatchMesh()).sky, 1, kPointRounding);
  PatchMesh below;
  add_floor(below, 1, -1);
  EXPECT_NEAR(from_origin(below).sky, 1, kPointRounding);
}

TEST(PointFactors, OpenBoxShowsTheSkyThroughItsOpening) {
  PatchMesh mesh;
  add_box(mesh, Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1), 3, Facing::inwards);
  PatchMesh open;
  open.vertices = mesh.vertices;
  open.surface_names = mesh.surface_names;
  open.surface_two_sided = mesh.surface_two_sided;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] != 1) open.add_patch(mesh.corners[i], mesh.surface[i], mesh.polygon[i]);
  }
  const Destinations shares = from_origin(open);
  EXPECT_NEAR(shares.sky, square_factor(1, 1), kPointRounding);
  EXPECT_EQ(shares.surfaces[0], 0);  // the floor that it lies on
  for (int wall = 2; wall < 6; ++wall) {
    EXPECT_NEAR(shares.surfaces[wall], (1 - square_factor(1, 1)) / 4, kPointRounding);
  }
}

TEST(PointFactors, ClosedRoomHasNoSky) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3(1, 2, 0.7), 7, Facing::inwards);
  add_box(mesh, Vec3(0.3, 0.4, 0.1), Vec3(0.6, 1.1, 0.5), 3, Facing::outwards);
  std::mt19937_64 random(kPointSeed);
  for (int k = 0; k < 20; ++k) {
    const Vec3 point(0.2 + 0.01 * k, 0.2 + 0.08 * k, 0.05);
    const Destinations shares = point_factors(mesh, point, random_unit(random));
    EXPECT_NEAR(shares.sky, 0, kPointRounding) << k;
    EXPECT_NEAR(shares.backs, 0, kPointRounding) << k;
    EXPECT_NEAR(shares.sum(), 1, 10 * kPointRounding) << k;
  }
}

TEST(PointFactors, BacksBlockAndAbsorb) {
  PatchMesh mesh;
  add_floor(mesh, 1, 1);
  add_ceiling(mesh, 4, 2);
  const Destinations shares = from_origin(mesh);
  EXPECT_EQ(shares.surfaces[0], 0);
  EXPECT_NEAR(shares.backs, square_factor(1, 1), kPointRounding);
  EXPECT_NEAR(shares.surfaces[1], square_factor(4, 2) - square_factor(1, 1), kPointRounding);
  EXPECT_NEAR(shares.sky, 1 - square_factor(4, 2), kPointRounding);
}

TEST(PointFactors, TwoSidedSurfacesHaveNoBacks) {
  PatchMesh mesh;
  test::make_two_sided(mesh, add_floor(mesh, 1, 1));
  const Destinations shares = from_origin(mesh);
  EXPECT_NEAR(shares.surfaces[0], square_factor(1, 1), kPointRounding);
  EXPECT_EQ(shares.backs, 0);
}

TEST(PointFactors, FrontsHideBacksInTheirPlane) {
  PatchMesh plate;
  add_floor(plate, 1, 1);
  add_ceiling(plate, 1, 1, 3);
  const Destinations shares = from_origin(plate);
  EXPECT_NEAR(shares.surfaces[1], square_factor(1, 1), 1e-10);
  EXPECT_NEAR(shares.backs, 0, 1e-10);
  EXPECT_NEAR(shares.sum(), 1, 1e-10);
}

TEST(PointFactors, TwoFrontsInOnePlaneBothCount) {
  PatchMesh mesh;
  add_ceiling(mesh, 2, 1);
  add_ceiling(mesh, 1, 1);
  const Destinations shares = from_origin(mesh);
  EXPECT_NEAR(shares.surfaces[0], square_factor(2, 1), kPointRounding);
  EXPECT_NEAR(shares.surfaces[1], square_factor(1, 1), kPointRounding);
  EXPECT_NEAR(shares.sum(), 1 + square_factor(1, 1), kPointRounding);
}

TEST(PointFactors, APlaneThroughThePointHidesNothing) {
  PatchMesh mesh;
  add_floor(mesh, 2, 0, 4);
  add_ceiling(mesh, 2, 1);
  // A wall whose plane holds the point, beside it.
  add_grid(mesh, Vec3(0.5, 0, 0), Vec3(0.2, 0, 0), Vec3(0, 0, 0.5), 1, 1);
  const Destinations shares = from_origin(mesh);
  EXPECT_EQ(shares.surfaces[0], 0);
  EXPECT_EQ(shares.surfaces[2], 0);
  EXPECT_NEAR(shares.surfaces[1], square_factor(2, 1), kPointRounding);
}

TEST(PointFactors, SixDigitsPutAPointOnASurface) {
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  const Vec3 u = normal.unitOrthogonal();
  for (const double height : {-4e-7, 4e-7}) {
    for (const bool is_two_sided : {false, true}) {
      PatchMesh mesh;
      const auto own = add_grid(mesh, Vec3(0.1, 0.2, 0.3), u, normal.cross(u), 1, 1);
      if (is_two_sided) test::make_two_sided(mesh, own);
      const Vec3 point = mesh.centroid[0] + height * normal;
      EXPECT_NEAR(point_factors(mesh, point, normal).sky, 1, kPointRounding);
      // On the other side it is a two-sided surface's own, or sees the front of a one-sided one.
      const Destinations below = point_factors(mesh, point, -normal);
      EXPECT_NEAR(below.sky, is_two_sided || height < 0 ? 1 : 0, 1e-5);
    }
  }
}

TEST(PointFactors, PatchesThatCrossHideEachOtherInPart) {
  // Two squares that cross in the line x = 0, z = 1, mirror images of each other.
  PatchMesh mesh;
  test::make_two_sided(mesh,
                       add_grid(mesh, Vec3(-0.5, -1, 0.8), Vec3(0, 2, 0), Vec3(1, 0, 0.4), 1, 1));
  test::make_two_sided(mesh,
                       add_grid(mesh, Vec3(-0.5, -1, 1.2), Vec3(0, 2, 0), Vec3(1, 0, -0.4), 1, 1));
  const Destinations shares = from_origin(mesh);
  EXPECT_NEAR(shares.surfaces[0], shares.surfaces[1], kPointRounding);
  // Together they cover what their nearer halves do, a strip up to x/z = 0.5/0.8 each side.
  PatchMesh strip;
  add_grid(strip, Vec3(-0.5, -1, 0.8), Vec3(0, 2, 0), Vec3(0.5, 0, 0.2), 1, 1);
  EXPECT_NEAR(shares.surfaces[0], from_origin(strip).surfaces[0], kPointRounding);
}

TEST(PointFactors, QuadsMayBeBentALittle) {
  // Rounded coordinates bend a quad, so that a part of it lies behind its mean plane.
  PatchMesh mesh;
  add_box(mesh, Vec3(-1, -1, 0), Vec3(1, 1, 2), 1, Facing::inwards);
  add_ceiling(mesh, 1.8, 1);
  mesh.vertices.back().z() += 1e-7;
  for (int k = 0; k < 10; ++k) {
    const Destinations shares = point_factors(mesh, Vec3(0.08 * k, 0.06 * k, 0), Vec3::UnitZ());
    EXPECT_NEAR(shares.sky, 0, kPointRounding) << k;
    EXPECT_NEAR(shares.sum(), 1, 10 * kPointRounding) << k;
  }
}

TEST(PointFactors, RandomScenesAddUpAndAgreeWithRays) {
  constexpr int kRays = 20000;
  std::mt19937_64 random(kPointSeed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const int n_patches : {10, 100, 1000}) {
    const PatchMesh mesh = random_scene(random, n_patches);
    const Visibility visibility(mesh);
    for (int k = 0; k < 4; ++k) {
      SCOPED_TRACE(testing::Message() << "seed " << kPointSeed << ", " << n_patches << ", " << k);
      const Vec3 point(uniform(random), uniform(random), uniform(random));
      const Vec3 normal = random_unit(random);
      const Destinations exact = point_factors(mesh, point, normal);
      EXPECT_NEAR(exact.sum(), 1, 1e-11);
      Destinations sampled{Eigen::VectorXd::Zero(exact.surfaces.size())};
      for (int ray = 0; ray < kRays; ++ray) {
        const double azimuth = 2 * kPi * uniform(random);
        const double square = uniform(random);
        const Vec3 u = normal.unitOrthogonal();
        const Vec3 direction =
            std::sqrt(square) * (std::cos(azimuth) * u + std::sin(azimuth) * normal.cross(u)) +
            std::sqrt(1 - square) * normal;
        const auto hit = visibility.first_hit(point, direction);
        double& share = !hit          ? sampled.sky
                        : !hit->front ? sampled.backs
                                      : sampled.surfaces[mesh.surface[hit->patch]];
        share += 1.0 / kRays;
      }
      const auto expect_near = [&](double value, double estimate) {
        // One ray more or less is always possible.
        const double sigma = std::sqrt(std::max(value, estimate) / kRays);
        EXPECT_NEAR(value, estimate, 5 * sigma + 3.0 / kRays);
      };
      expect_near(exact.sky, sampled.sky);
      expect_near(exact.backs, sampled.backs);
      for (Index s = 0; s < exact.surfaces.size(); ++s) {
        expect_near(exact.surfaces[s], sampled.surfaces[s]);
      }
    }
  }
}

TEST(PointFactors, SameBitsAtAnyNumberOfThreads) {
  std::mt19937_64 random(kPointSeed);
  const PatchMesh mesh = random_scene(random, 300);
  const auto shares = [&](std::size_t n_threads) {
    const ThreadLimit limit(n_threads);
    return point_factors(mesh, Vec3::Constant(0.5), Vec3::UnitX()).surfaces;
  };
  EXPECT_EQ(shares(1), shares(3));
}

TEST(PointFactors, StopsWhenAskedTo) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 2, Facing::inwards);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(point_factors(mesh, Vec3::Constant(0.5), Vec3::UnitX(), {{}, source.get_token()}),
               Interrupted);
}

}  // namespace
}  // namespace radiosity
