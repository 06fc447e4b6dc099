#include "radiosity/picture/final_gather.h"
#include "radiosity/picture/gather_interpolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stop_token>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;

constexpr std::uint64_t kSeed = 271828;
/// Thousands of form factors and their parts, each with a few roundings of 1.1e-16 of angles near
/// 1, and shadows' edges that are off by as much.
constexpr double kExact = 1e-9;
/// Quads count as planar if they are to this share of their diagonal; form factors are those of
/// their projections.
constexpr double kPlanarity = 1e-6;

/// Radiosities from 0.5 to 1.5 in two bands, different on each patch.
Eigen::MatrixXd random_radiosity(const PatchMesh& mesh, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  return Eigen::MatrixXd::NullaryExpr(mesh.size(), 2, [&] { return uniform(random); });
}

/// A point inside a patch.
SurfacePoint random_point(const PatchMesh& mesh, std::int32_t patch, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  double u = uniform(random);
  double v = uniform(random);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vec3& a = mesh.corner(patch, 0);
  return {patch, a + u * (mesh.corner(patch, 1) - a) + v * (mesh.corner(patch, 2) - a)};
}

std::vector<SurfacePoint> random_points(const PatchMesh& mesh, int n, std::mt19937_64& random) {
  std::vector<SurfacePoint> points;
  for (int k = 0; k < n; ++k) {
    points.push_back(random_point(mesh, static_cast<std::int32_t>(random() % mesh.size()), random));
  }
  return points;
}

/// n x n points about a point of a patch, `spread` apart in the patch's plane.
std::vector<SurfacePoint> tile_of_points(const PatchMesh& mesh, const SurfacePoint& middle, int n,
                                         double spread) {
  const Vec3 u = mesh.normal[middle.patch].unitOrthogonal();
  const Vec3 v = mesh.normal[middle.patch].cross(u);
  std::vector<SurfacePoint> points;
  for (int k = 0; k < n * n; ++k) {
    const int row = k / n;
    const double s = (k % n - 0.5 * (n - 1)) * spread;
    const double t = (row - 0.5 * (n - 1)) * spread;
    points.push_back({middle.patch, middle.position + s * u + t * v});
  }
  return points;
}

/// The same mesh with each patch a surface of its own.
PatchMesh with_surfaces_of_patches(const PatchMesh& mesh) {
  PatchMesh result = mesh;
  result.surface_names.assign(mesh.size(), "patch");
  result.surface_two_sided.assign(mesh.size(), false);
  for (Index i = 0; i < mesh.size(); ++i) {
    result.surface[i] = static_cast<std::int32_t>(i);
    result.surface_two_sided[i] = mesh.twin[i] >= 0;
  }
  return result;
}

Eigen::RowVectorXd exact_irradiance(const PatchMesh& mesh_of_patches,
                                    const Eigen::MatrixXd& radiosity, const SurfacePoint& point) {
  const Destinations shares =
      point_factors(mesh_of_patches, point.position, mesh_of_patches.normal[point.patch]);
  return shares.surfaces.transpose() * radiosity;
}

/// Compares the irradiance at points, gathered together, with the exact sum at each of them, or at
/// one in `step`.
void expect_exact(const PatchMesh& mesh, std::span<const SurfacePoint> points, double tolerance,
                  std::size_t step = 1) {
  std::mt19937_64 random(kSeed);
  const Eigen::MatrixXd radiosity = random_radiosity(mesh, random);
  const FinalGather gather(mesh, radiosity);
  const PatchMesh of_patches = with_surfaces_of_patches(mesh);
  const Eigen::MatrixXd irradiance = gather.irradiance(points);
  for (std::size_t k = 0; k < points.size(); k += step) {
    const Eigen::RowVectorXd expected = exact_irradiance(of_patches, radiosity, points[k]);
    const double error = (irradiance.row(static_cast<Index>(k)) - expected).cwiseAbs().maxCoeff();
    EXPECT_LE(error, tolerance * expected.maxCoeff())
        << "seed " << kSeed << ", point " << k << " at " << points[k].position.transpose();
  }
}

PatchMesh empty_box(int n) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3(1, 1.2, 0.8), n, Facing::inwards);
  return mesh;
}

/// A closed room with a box that stands on the floor, one that floats, and a two-sided screen.
PatchMesh room_with_boxes(int n) {
  PatchMesh mesh = empty_box(2 * n);
  add_box(mesh, Vec3(0.2, 0.3, 0), Vec3(0.5, 0.5, 0.4), n, Facing::outwards);
  add_box(mesh, Vec3(0.55, 0.6, 0.3), Vec3(0.8, 0.9, 0.5), n, Facing::outwards);
  test::make_two_sided(mesh,
                       add_grid(mesh, Vec3(0.1, 0.7, 0), Vec3(0.3, 0.2, 0), Vec3(0, 0, 0.5), n, n));
  return mesh;
}

PatchMesh scene_patches(const std::string& name, long n) {
  return meshing::make_patches(io::read_scene(RADIOSITY_SCENES "/" + name), {.n_patches = n});
}

TEST(FinalGather, IsExactInAnEmptyBox) {
  const PatchMesh mesh = empty_box(8);
  std::mt19937_64 random(kSeed);
  for (const SurfacePoint& point : random_points(mesh, 40, random)) {
    expect_exact(mesh, {&point, 1}, kExact);
  }
}

TEST(FinalGather, IsExactForScatteredPoints) {
  const PatchMesh mesh = room_with_boxes(3);
  std::mt19937_64 random(kSeed);
  expect_exact(mesh, random_points(mesh, 100, random), kInterpolationTolerance);
}

TEST(FinalGather, IsExactForSinglePointsAmongBoxes) {
  const PatchMesh mesh = room_with_boxes(3);
  std::mt19937_64 random(kSeed);
  for (const SurfacePoint& point : random_points(mesh, 60, random)) {
    expect_exact(mesh, {&point, 1}, kExact);
  }
}

TEST(FinalGather, InterpolatesWithinItsTolerance) {
  const PatchMesh mesh = room_with_boxes(3);
  std::mt19937_64 random(kSeed);
  for (const SurfacePoint& middle : random_points(mesh, 12, random)) {
    expect_exact(mesh, tile_of_points(mesh, middle, 8, 1e-4), kInterpolationTolerance, 9);
  }
}

TEST(FinalGather, TakesPointsOnALine) {
  const PatchMesh mesh = room_with_boxes(3);
  std::mt19937_64 random(kSeed);
  const SurfacePoint middle = random_point(mesh, 5, random);
  auto points = tile_of_points(mesh, middle, 6, 1e-3);
  points.resize(6);  // a row
  expect_exact(mesh, points, kInterpolationTolerance);
  points.assign(9, middle);
  expect_exact(mesh, points, kInterpolationTolerance);
}

TEST(FinalGather, IsExactInTheCornellBox) {
  const PatchMesh mesh = scene_patches("cornell-box.json", 400);
  std::mt19937_64 random(kSeed);
  for (const SurfacePoint& point : random_points(mesh, 30, random)) {
    expect_exact(mesh, {&point, 1}, kExact);
    expect_exact(mesh, tile_of_points(mesh, point, 3, 1e-4), kInterpolationTolerance, 4);
  }
}

TEST(FinalGather, IsExactInTheFurnishedRoom) {
  const PatchMesh mesh = scene_patches("furnished-room.json", 600);
  std::mt19937_64 random(kSeed);
  for (const SurfacePoint& point : random_points(mesh, 12, random)) {
    expect_exact(mesh, {&point, 1}, kPlanarity);
  }
}

// The beam through an opening has sharp edges, and adds to what the patches send.
TEST(FinalGather, AddsTheSunWhereItShines) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(-2, -2, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 3, 3);
  // A lid with a hole [-0.5, 0.5] x [0, 0.5] at height 1, seen from below.
  const auto lid = [&](double x0, double x1, double y0, double y1) {
    add_grid(mesh, Vec3(x0, y0, 1), Vec3(0, y1 - y0, 0), Vec3(x1 - x0, 0, 0), 1, 1);
  };
  lid(-2, 2, -2, 0);
  lid(-2, 2, 0.5, 2);
  lid(-2, -0.5, 0, 0.5);
  lid(0.5, 2, 0, 0.5);
  Scene scene;
  scene.sun = Sun{.direction = Vec3(0.6, 0, -0.8), .irradiance = Eigen::Vector2d(100, 7)};
  const Eigen::MatrixXd radiosity = Eigen::MatrixXd::Constant(mesh.size(), 2, 0.5);
  const FinalGather without(mesh, radiosity);
  const FinalGather gather(mesh, radiosity, {scene, mesh});
  const auto direct = [&](double x, double y, double z) {
    const Vec3 point(x, y, z);
    const Vec3 up(0, 0, 1);
    return Eigen::RowVectorXd(gather.irradiance({&point, 1}, up).row(0) -
                              without.irradiance({&point, 1}, up).row(0));
  };
  // On the floor the beam lies 0.75 further, at height 0.5 half as far.
  for (const double z : {0.0, 0.5}) {
    const double shift = 0.75 * (1 - z);
    for (const double x : {-0.5 + 1e-6, 0.0, 0.5 - 1e-6}) {
      EXPECT_TRUE(direct(x + shift, 0.25, z).isApprox(Eigen::RowVector2d(80, 5.6), 1e-12));
    }
    for (const double x : {-0.5 - 1e-6, 0.5 + 1e-6, 1.2}) {
      EXPECT_TRUE(direct(x + shift, 0.25, z).isZero(0));
    }
    EXPECT_TRUE(direct(shift, 0.5 + 1e-6, z).isZero(0));
  }
  const SurfacePoint on_floor = {4, Vec3(0.7, 0.25, 0)};
  const Eigen::MatrixXd more =
      gather.irradiance({&on_floor, 1}) - without.irradiance({&on_floor, 1});
  EXPECT_NEAR(more(0, 0), 80, 1e-10);
}

TEST(FinalGather, UniformRadiosityGivesItselfInAClosedRoom) {
  const PatchMesh mesh = room_with_boxes(3);
  std::mt19937_64 random(kSeed);
  const FinalGather gather(mesh, Eigen::MatrixXd::Constant(mesh.size(), 1, 2.5));
  std::vector<SurfacePoint> points;
  for (const SurfacePoint& point : random_points(mesh, 200, random)) {
    // The screen and the standing box cover parts of the floor.
    const Vec3& x = point.position;
    const bool is_covered =
        x.z() == 0 && x.x() > 0.1999 && x.x() < 0.5001 && x.y() > 0.2999 && x.y() < 0.5001;
    if (!is_covered) points.push_back(point);
  }
  for (const SurfacePoint& point : points) {
    const double irradiance = gather.irradiance({&point, 1})(0, 0);
    // The standing box has a bottom that nothing sees, and the floor under it.
    const bool is_bottom = point.position.z() == 0 && mesh.normal[point.patch].z() < 0;
    EXPECT_NEAR(irradiance, is_bottom ? 0 : 2.5, 2.5 * kExact) << point.position.transpose();
  }
}

TEST(FinalGather, CoveredFloorIsDarkAndEdgesAreFinite) {
  const PatchMesh mesh = room_with_boxes(1);
  const FinalGather gather(mesh, Eigen::MatrixXd::Ones(mesh.size(), 1));
  const std::vector<SurfacePoint> covered = {{0, Vec3(0.35, 0.4, 0)}};
  EXPECT_EQ(gather.irradiance(covered)(0, 0), 0);
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const SurfacePoint corner{static_cast<std::int32_t>(i), mesh.corner(i, k)};
      const double irradiance = gather.irradiance({&corner, 1})(0, 0);
      EXPECT_GE(irradiance, 0);
      EXPECT_LE(irradiance, 1 + kExact);
    }
  }
}

TEST(FinalGather, SettledPointsAtBordersAreFullyLit) {
  const PatchMesh mesh = room_with_boxes(1);
  const FinalGather gather(mesh, Eigen::MatrixXd::Ones(mesh.size(), 1));
  const auto irradiance = [&](std::int32_t patch, const Vec3& x) {
    const SurfacePoint point = gather.settled({patch, x});
    return gather.irradiance({&point, 1})(0, 0);
  };
  // A hair outside the room, and a hair inside the box that stands on the floor.
  EXPECT_NEAR(irradiance(0, Vec3(0.3, -1e-7, 1e-7)), 1, kExact);
  EXPECT_NEAR(irradiance(0, Vec3(0.3, 0.3 + 1e-7, 0)), 1, kExact);
}

constexpr int kSide = 24;

Image picture(const PatchMesh& mesh, const Eigen::MatrixXd& radiosity,
              const RenderOptions& options) {
  const Visibility visibility(mesh);
  const FinalGather gather(mesh, radiosity);
  const Eigen::MatrixXd exitance = 0.5 * radiosity;
  const Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(mesh.size(), radiosity.cols(), 0.5);
  Camera camera;
  camera.position = Vec3(0.1, 0.1, 0.7);
  camera.direction = Vec3(1, 1, -1).normalized();
  camera.up = Vec3::UnitZ();
  camera.vertical_fov = 1.2;
  return render_gathered(gather, visibility, {exitance, reflectance}, camera, options);
}

TEST(GatheredPicture, OfAFurnaceIsConstant) {
  const PatchMesh mesh = room_with_boxes(2);
  const Image image = picture(mesh, Eigen::MatrixXd::Constant(mesh.size(), 3, kPi),
                              {.width = kSide, .height = kSide, .samples = 4});
  EXPECT_LT((image.values.array() - 1).abs().maxCoeff(), kInterpolationTolerance);
  for (const float alpha : image.alpha) EXPECT_EQ(alpha, 1);
}

TEST(GatheredPicture, IsTheSameAtAnyNumberOfThreads) {
  const PatchMesh mesh = room_with_boxes(2);
  std::mt19937_64 random(kSeed);
  const Eigen::MatrixXd radiosity = random_radiosity(mesh, random);
  const auto with_threads = [&](std::size_t n) {
    const ThreadLimit limit(n);
    return picture(mesh, radiosity, {.width = kSide, .height = kSide, .samples = 4});
  };
  EXPECT_EQ(with_threads(1).values, with_threads(2).values);
}

TEST(GatheredPicture, ReportsRowsAndStops) {
  const PatchMesh mesh = empty_box(1);
  const Eigen::MatrixXd radiosity = Eigen::MatrixXd::Ones(mesh.size(), 1);
  double last = 0;
  RenderOptions options{.width = kSide, .height = kSide, .samples = 1};
  options.progress.report = [&](std::string_view, double done, double total, std::string_view) {
    last = std::max(last, done);
    EXPECT_EQ(total, kSide);
  };
  picture(mesh, radiosity, options);
  EXPECT_EQ(last, kSide);
  std::stop_source source;
  source.request_stop();
  options.progress.stop = source.get_token();
  EXPECT_THROW(picture(mesh, radiosity, options), Interrupted);
}

}  // namespace
}  // namespace radiosity
