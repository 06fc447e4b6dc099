#include "radiosity/polygon/flat_overlap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

namespace {

using namespace radiosity;

using Outline = std::vector<Point2>;
constexpr double kOverlapThickness = 1e-9;

Outline rectangle(double x0, double x1, double y0, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(FlatOverlap, BordersAreNone) {
  // A pavement, and a triangle on the slanted edge of another one.
  EXPECT_FALSE(has_overlap({rectangle(0, 1, 0, 1), rectangle(1, 2, 0, 1), rectangle(0, 2, 1, 2)},
                           kOverlapThickness));
  EXPECT_FALSE(
      has_overlap({{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}}, kOverlapThickness));
  EXPECT_FALSE(has_overlap({rectangle(0, 1, 0, 1), rectangle(1 - kOverlapThickness / 2, 2, 0, 1)},
                           kOverlapThickness));
}

TEST(FlatOverlap, FindsOneAmongMany) {
  std::vector<Outline> tiles;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) tiles.push_back(rectangle(x, x + 1, y, y + 1));
  }
  EXPECT_FALSE(has_overlap(tiles, kOverlapThickness));
  tiles.push_back({{4.4, 4.4}, {4.6, 4.4}, {4.5, 4.6}});
  EXPECT_TRUE(has_overlap(tiles, kOverlapThickness));
}

TEST(FlatOverlap, BoxesThatMeetProveNothing) {
  // A corner of one lies in the box of the other, but beyond its slanted edge.
  EXPECT_FALSE(
      has_overlap({{{0, 0}, {1, 0}, {0, 1}}, rectangle(0.6, 2, 0.6, 2)}, kOverlapThickness));
  EXPECT_TRUE(
      has_overlap({{{0, 0}, {1, 0}, {0, 1}}, rectangle(0.4, 2, 0.4, 2)}, kOverlapThickness));
}

/// Four rectangles around a square hole of that size in the middle of a square of side 1, each
/// along the end of the next one, turned, with coordinates off by up to `digit`.
std::vector<std::vector<Point2>> pinwheel(double hole, double angle, double digit) {
  const double a = 0.5 - 0.5 * hole;
  const double b = 0.5 + 0.5 * hole;
  std::vector<std::vector<Point2>> result = {{{0, 0}, {b, 0}, {b, a}, {0, a}},
                                             {{b, 0}, {1, 0}, {1, b}, {b, b}},
                                             {{a, b}, {1, b}, {1, 1}, {a, 1}},
                                             {{0, a}, {a, a}, {a, 1}, {0, 1}}};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> off(-digit, digit);
  for (auto& polygon : result) {
    for (Point2& point : polygon) {
      point = Eigen::Rotation2Dd(angle) * point + Point2(off(random), off(random));
    }
  }
  return result;
}

TEST(HasGap, FindsHolesAndNotWhatRoundingLeaves) {
  constexpr double kWidth = 1e-3;
  for (int k = 0; k < 20; ++k) {
    const double angle = 0.3 * k;
    std::vector<Point2> hull = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (Point2& point : hull) point = Eigen::Rotation2Dd(angle) * point;
    EXPECT_TRUE(has_gap(pinwheel(2 * kWidth, angle, kWidth / 16), hull, kWidth)) << k;
    EXPECT_TRUE(has_gap(pinwheel(0.3, angle, kWidth / 16), hull, kWidth)) << k;
    EXPECT_FALSE(has_gap(pinwheel(0, angle, kWidth / 16), hull, kWidth)) << k;
    EXPECT_FALSE(has_gap(pinwheel(0, angle, 0), hull, kWidth)) << k;
    auto notched = pinwheel(0, angle, 0);
    notched.erase(notched.begin());
    EXPECT_TRUE(has_gap(notched, hull, kWidth)) << k;
  }
}

}  // namespace
