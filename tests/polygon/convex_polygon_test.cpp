#include "radiosity/polygon/convex_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace radiosity {
namespace {

double area(const ConvexPolygon& polygon) { return vector_area(polygon.points()).norm(); }

// What is left of many cuts is convex to rounding only: a plane along a row of its corners may go
// through it many times, and so has each part no more than one corner more than the whole.
TEST(ConvexPolygon, IsSplitInTwoAlongAnEdgeWithRoundedCorners) {
  std::mt19937_64 random(7);  // NOLINT: fixed seed
  std::uniform_real_distribution<double> shift(-1e-16, 1e-16);
  const std::size_t n = ConvexPolygon::kCapacity - 1;
  for (int trial = 0; trial < 1000; ++trial) {
    // A half disc of 1 m, or a whole one, with four to eight corners in a row on y = 0.
    const std::size_t n_in_row = 4 + trial % 5;
    ConvexPolygon polygon;
    for (std::size_t k = 0; k < n_in_row; ++k) {
      const double x = 2 * static_cast<double>(k) / static_cast<double>(n_in_row - 1) - 1;
      polygon.push_back({x, shift(random), 0});
    }
    for (std::size_t k = 1; k <= n - n_in_row; ++k) {
      const double angle = M_PI * static_cast<double>(k) / static_cast<double>(n - n_in_row + 1);
      polygon.push_back({std::cos(angle), std::sin(angle), 0});
    }
    ConvexPolygon above;
    ConvexPolygon below;
    split(polygon, Vec3::Zero(), Vec3::UnitY(), 0, above, below);
    EXPECT_LE(above.size(), n + 1);
    EXPECT_LE(below.size(), n + 1);
    EXPECT_NEAR(area(above), area(polygon), 1e-15);
    EXPECT_LE(below.empty() ? 0 : area(below), 1e-15);
    const ConvexPolygon clipped =
        clip_to_half_space(polygon.points(), Vec3::Zero(), -Vec3::UnitY(), 0);
    EXPECT_LE(clipped.empty() ? 0 : area(clipped), 1e-15);
    ConvexPolygon kept = polygon;
    keep_above(Vec3::Zero(), Vec3::UnitY(), kept);
    EXPECT_NEAR(area(kept), area(polygon), 1e-15);
  }
}

TEST(ConvexPolygon, IsSplitInPartsThatMakeTheWhole) {
  std::mt19937_64 random(8);  // NOLINT: fixed seed
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    ConvexPolygon polygon;
    const int n = 3 + trial % 9;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * M_PI * (k + 0.4 * uniform(random)) / n;
      polygon.push_back({std::cos(angle), std::sin(angle), 0});
    }
    const Vec3 normal = Vec3(uniform(random), uniform(random), uniform(random)).normalized();
    const Vec3 on_plane(uniform(random), uniform(random), 0);
    ConvexPolygon above;
    ConvexPolygon below;
    const bool is_cut = split(polygon, on_plane, normal, 0, above, below);
    EXPECT_EQ(is_cut, !above.empty() && !below.empty());
    const double sum = (above.empty() ? 0 : area(above)) + (below.empty() ? 0 : area(below));
    EXPECT_NEAR(sum, area(polygon), 1e-14);
    for (const Vec3& corner : above) EXPECT_GE(normal.dot(corner - on_plane), -1e-15);
    for (const Vec3& corner : below) EXPECT_LE(normal.dot(corner - on_plane), 1e-15);
  }
}

}  // namespace
}  // namespace radiosity
