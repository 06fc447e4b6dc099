#include "radiosity/polygon/flat_overlap.h"

#include <gtest/gtest.h>

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

}  // namespace
