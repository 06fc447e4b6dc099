#include "radiosity/polygon/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace radiosity {
namespace {

constexpr double kHullThickness = 1e-9;

/// How far on the left of the line from a to b.
double height(const Point2& a, const Point2& b, const Point2& p) {
  return cross2((b - a).normalized(), p - a);
}

TEST(ConvexHull, HoldsAllPointsAndTurnsLeft) {
  std::mt19937_64 random(5);  // NOLINT: fixed seed
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Point2> points;
    const int n = 3 + trial % 40;
    for (int k = 0; k < n; ++k) points.emplace_back(normal(random), normal(random));
    // Some points twice.
    for (int k = 0; k < n; k += 3) points.push_back(points[k]);
    const std::vector<std::int32_t> hull = convex_hull(points, kHullThickness);
    ASSERT_GE(hull.size(), 3U) << trial;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Point2& a = points[hull[k]];
      const Point2& b = points[hull[(k + 1) % hull.size()]];
      const Point2& c = points[hull[(k + 2) % hull.size()]];
      EXPECT_GT(height(a, b, c), kHullThickness) << trial;
      for (const Point2& p : points) EXPECT_GE(height(a, b, p), -2 * kHullThickness) << trial;
    }
  }
}

TEST(ConvexHull, LeavesOutWhatLiesOnEdges) {
  std::vector<Point2> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const double t : {0.2, 0.5, 0.8}) {
    points.emplace_back(t, 0.5 * kHullThickness);
    points.emplace_back(1 - 0.5 * kHullThickness, t);
    points.emplace_back(t, t);
  }
  const std::vector<std::int32_t> hull = convex_hull(points, kHullThickness);
  ASSERT_EQ(hull.size(), 4U);
  for (const std::int32_t k : hull) EXPECT_LT(k, 4);
}

TEST(ConvexHull, ManyPointsOnACircleAreAllCornersUnlessTheyAreTooMany) {
  constexpr std::size_t kPoints = 2000;
  std::vector<Point2> points;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double angle = 2.39996 * static_cast<double>(k);  // in no order
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  const std::vector<std::int32_t> hull = convex_hull(points, kHullThickness);
  EXPECT_EQ(hull.size(), kPoints);
  EXPECT_EQ(convex_hull(points, kHullThickness, kPoints), hull);
  EXPECT_TRUE(convex_hull(points, kHullThickness, kPoints - 1).empty());
  // With a limit a hundred times as many are no matter.
  for (int turn = 1; turn < 100; ++turn) {
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double angle = 2.39996 * static_cast<double>(k) + 1e-5 * turn;
      points.emplace_back(std::cos(angle), std::sin(angle));
    }
  }
  EXPECT_TRUE(convex_hull(points, kHullThickness, 8).empty());
}

TEST(ConvexHull, PointsInALineHaveNone) {
  EXPECT_TRUE(convex_hull({}, kHullThickness).empty());
  EXPECT_TRUE(convex_hull({{1, 2}}, kHullThickness).empty());
  EXPECT_TRUE(convex_hull({{1, 2}, {3, 4}}, kHullThickness).empty());
  EXPECT_TRUE(convex_hull({{0, 0}, {1, 1}, {2, 2}, {3, 3 + 1e-10}}, kHullThickness).empty());
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {2, 2}, {3, 3.1}}, kHullThickness).size(), 3U);
}

}  // namespace
}  // namespace radiosity
