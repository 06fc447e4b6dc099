/// Form factors of random scenes: bounded, never above their unobstructed value, and equal to plain
/// Monte Carlo within its error.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/parallel.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::random_unit;

constexpr std::uint64_t kSceneSeed = 20260;

/// Triangles and rectangles of all sizes, anywhere in the unit cube, some crossing, some in one
/// plane.
PatchMesh random_scene(std::mt19937_64& random, int n_patches) {
  std::uniform_real_distribution<double> uniform(0, 1);
  PatchMesh mesh;
  mesh.surface_names = {"all"};
  mesh.surface_two_sided = {false};
  for (int i = 0; i < n_patches; ++i) {
    const bool is_axis_parallel = uniform(random) < 0.5;
    Vec3 center(uniform(random), uniform(random), uniform(random));
    Vec3 u = random_unit(random);
    Vec3 v = u.unitOrthogonal();
    if (is_axis_parallel) {
      const int axis = static_cast<int>(3 * uniform(random));
      u = Vec3::Unit(axis);
      v = Vec3::Unit((axis + 1) % 3);
      center = (4 * center).array().round() / 4;
      // A plane of its own: of patches that overlap in one plane it is not defined which is in
      // front.
      center[(axis + 2) % 3] = (i + 0.5) / n_patches;
    }
    const double size = is_axis_parallel ? 0.125 * std::ceil(4 * uniform(random))
                                         : std::pow(10, -1.5 * uniform(random));
    u *= size / 2;
    v *= size / 2 * (uniform(random) < 0.5 ? 1 : -1);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    const bool is_quad = uniform(random) < 0.6;
    mesh.vertices.insert(mesh.vertices.end(), {center - u - v, center + u - v, center + u + v});
    if (is_quad) mesh.vertices.push_back(center - u + v);
    mesh.add_patch({first, first + 1, first + 2, is_quad ? first + 3 : -1}, 0,
                   static_cast<std::int32_t>(i));
  }
  return mesh;
}

std::vector<Vec3> outline(const PatchMesh& mesh, Index i) {
  std::vector<Vec3> points;
  for (int k = 0; k < mesh.n_corners(i); ++k) points.push_back(mesh.corner(i, k));
  return points;
}

Vec3 random_point(const PatchMesh& mesh, Index i, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vec3& a = mesh.corner(i, 0);
  const Vec3 u = mesh.corner(i, 1) - a;
  if (mesh.n_corners(i) == 4)
    return a + uniform(random) * u + uniform(random) * (mesh.corner(i, 3) - a);
  const double root = std::sqrt(uniform(random));
  return a + root * (u + uniform(random) * (mesh.corner(i, 2) - a - u));
}

/// Shares of the cosine-distributed rays from patch i that meet the front of each patch.
Eigen::VectorXd sampled_row(const PatchMesh& mesh, const Visibility& visibility, Index i,
                            int n_rays, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(mesh.size());
  const Vec3 u = mesh.normal[i].unitOrthogonal();
  const Vec3 v = mesh.normal[i].cross(u);
  for (int k = 0; k < n_rays; ++k) {
    const double azimuth = 2 * kPi * uniform(random);
    const double square = uniform(random);
    const Vec3 direction = std::sqrt(square) * (std::cos(azimuth) * u + std::sin(azimuth) * v) +
                           std::sqrt(1 - square) * mesh.normal[i];
    const auto hit = visibility.first_hit(random_point(mesh, i, random), direction,
                                          static_cast<std::int32_t>(i));
    if (hit && hit->front) row[hit->patch] += 1.0 / n_rays;
  }
  return row;
}

TEST(RandomScenes, FactorsAreBoundedAndAgreeWithMonteCarlo) {
  constexpr int kScenes = 7;
  constexpr int kPatches = 40;
  constexpr int kRays = 100000;
  std::mt19937_64 random(kSceneSeed);
  int n_pairs = 0;
  int n_beyond_three = 0;
  for (int scene = 0; scene < kScenes; ++scene) {
    const PatchMesh mesh = random_scene(random, kPatches);
    const Visibility visibility(mesh);
    const auto transport = make_dense_transport(mesh, visibility, {.tolerance = 1e-3});
    for (Index i = 0; i < mesh.size(); ++i) {
      const Eigen::VectorXd row = rows_of(*transport).row(i);
      const Eigen::VectorXd error = rows_of(*transport).row_error(i);
      const Eigen::VectorXd sampled = sampled_row(mesh, visibility, i, kRays, random);
      EXPECT_GE(row.minCoeff(), 0);
      for (Index j = 0; j < mesh.size(); ++j) {
        if (i == j) continue;
        const double whole = exchange_area(outline(mesh, i), outline(mesh, j)) / mesh.area[i];
        EXPECT_LE(row[j], whole * (1 + 1e-8) + 1e-15) << "scene " << scene << ": " << i << " " << j;
        const double probability = std::max(row[j], sampled[j]);
        const double sigma =
            std::sqrt(probability * (1 - std::min(probability, 1.0)) / kRays + error[j] * error[j]);
        const double difference = std::abs(row[j] - sampled[j]);
        // One hit more or less is always possible.
        EXPECT_LE(difference, 5 * sigma + 3.0 / kRays)
            << "seed " << kSceneSeed << ", scene " << scene << ": " << i << " " << j << ", F "
            << row[j] << " ± " << error[j] << ", rays " << sampled[j] << ", unobstructed " << whole;
        n_beyond_three += difference > 3 * sigma + 1.0 / kRays ? 1 : 0;
        ++n_pairs;
      }
    }
  }
  EXPECT_GT(n_pairs, 10000);
  // A normal distribution has 0.3 % beyond three sigma; most pairs are far below one ray.
  EXPECT_LT(n_beyond_three, 0.003 * n_pairs);
}

}  // namespace
