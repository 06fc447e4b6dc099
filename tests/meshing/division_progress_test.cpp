// What is told while very many patches are made.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/scene.h"

namespace {

using radiosity::Scene;
using radiosity::Vec3;

/// A prism of n walls with regular floor and ceiling, normals inwards, turned at random. Its walls
/// are grids; floor and ceiling are filled unless n is 4.
Scene prism(int n, double height, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random))
          .normalized();
  Scene scene;
  scene.surfaces.push_back({.name = "all", .material = 0, .two_sided = false});
  for (const double z : {0.0, height}) {
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * radiosity::kPi * k / n;
      scene.vertices.emplace_back(turn * Vec3(std::cos(angle), std::sin(angle), z));
    }
  }
  std::vector<std::int32_t> floor;
  std::vector<std::int32_t> ceiling;
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    floor.push_back(k);
    ceiling.push_back(2 * n - 1 - k);
    scene.add_polygon(std::vector<std::int32_t>{k, n + k, n + next, next}, 0);
  }
  scene.add_polygon(floor, 0);
  scene.add_polygon(ceiling, 0);
  return scene;
}

/// Shares of the division as they are told.
std::vector<double> told_shares(const Scene& scene, long n_patches) {
  std::vector<double> shares;
  const auto report = [&](std::string_view stage, double done, double total, std::string_view) {
    EXPECT_EQ(stage, "dividing");
    shares.push_back(done / total);
  };
  meshing::make_patches(scene,
                        {.n_patches = n_patches, .progress = {.report = report, .stop = {}}});
  return shares;
}

// From nothing to all, in small steps and never back, whether grids or triangles are made and
// however often.
TEST(DivisionProgress, GrowsFromNothingToAll) {
  std::mt19937 random(7);
  for (const int n : {3, 4, 5, 8}) {
    for (const double height : {0.1, 1.0, 9.0}) {
      const std::vector<double> shares = told_shares(prism(n, height, random), 120'000);
      ASSERT_GE(shares.size(), 3U) << n << ' ' << height;
      double before = 0;
      for (const double share : shares) {
        EXPECT_GE(share, before) << n << ' ' << height;
        before = share;
      }
      EXPECT_LE(before, 1);
      // One of two attempts may have been enough.
      EXPECT_GT(before, 0.45) << n << ' ' << height;
    }
  }
}

TEST(DivisionProgress, SaysNothingOfFewPatchesAndStopsAmongMany) {
  std::mt19937 random(8);
  const Scene scene = prism(7, 0.1, random);
  EXPECT_TRUE(told_shares(scene, 2000).empty());
  std::stop_source stop;
  const radiosity::Progress progress{
      .report = [&](std::string_view, double, double, std::string_view) { stop.request_stop(); },
      .stop = stop.get_token()};
  EXPECT_THROW(meshing::make_patches(scene, {.n_patches = 200'000, .progress = progress}),
               radiosity::Interrupted);
}

}  // namespace
