/// The planes about a pair, against segments between its polygons.

#include "radiosity/exchange/pair_hull.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/scene_random.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;

constexpr std::uint64_t kHullSeed = 83;

/// A parallelogram or, half as often, a triangle.
ConvexPolygon random_polygon(test::Random& random) {
  const Vec3 corner = random.vector(-1, 1);
  const Vec3 u = random.vector(-1, 1);
  const Vec3 v = random.vector(-1, 1);
  std::vector<Vec3> corners{corner, corner + u, corner + u + v, corner + v};
  if (random.uniform(0, 3) < 1) corners.pop_back();
  return ConvexPolygon(corners);
}

// A box about a point of a segment is in the way: no plane may prove otherwise, wherever the
// polygons lie and how far they reach past each other.
TEST(PairHull, NeverMissesWhatASegmentMeets) {
  SCOPED_TRACE(testing::Message() << "seed " << kHullSeed);
  test::Random random(kHullSeed);
  std::mt19937_64 points(kHullSeed);
  for (int pair = 0; pair < 300; ++pair) {
    const ConvexPolygon source = random_polygon(random);
    const ConvexPolygon target = random_polygon(random);
    const PairHull hull(source, target, 0);
    for (int segment = 0; segment < 100; ++segment) {
      const Vec3 from = test::random_point(source.points(), points);
      const Vec3 to = test::random_point(target.points(), points);
      const Vec3 point = from + random.uniform() * (to - from);
      const Box3 box(point - random.vector(1e-9, 0.3), point + random.vector(1e-9, 0.3));
      ASSERT_FALSE(hull.misses(box)) << "pair " << pair;
    }
  }
}

TEST(PairHull, MissesWhatIsBeside) {
  const ConvexPolygon source(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const ConvexPolygon target(std::vector<Vec3>{{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}});
  const PairHull hull(source, target, 0);
  const Vec3 half = Vec3::Constant(0.1);
  for (const Vec3& center : {Vec3(-0.2, 0.5, 1), Vec3(1.2, 0.5, 1), Vec3(0.5, -0.2, 1),
                             Vec3(0.5, 1.2, 1), Vec3(1.5, 1.5, 0.5)}) {
    EXPECT_TRUE(hull.misses(Box3(center - half, center + half))) << center.transpose();
  }
  EXPECT_FALSE(hull.misses(Box3(Vec3(0.4, 0.4, 0.9), Vec3(0.6, 0.6, 1.1))));
}

TEST(PairHull, LeavesOutWhatReachesInByTheThickness) {
  const ConvexPolygon source(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const ConvexPolygon target(std::vector<Vec3>{{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}});
  constexpr double kThickness = 1e-3;
  const Box3 beside(Vec3(-1, 0.4, 0.9), Vec3(0.9 * kThickness, 0.6, 1.1));
  EXPECT_FALSE(PairHull(source, target, 0).misses(beside));
  EXPECT_TRUE(PairHull(source, target, kThickness).misses(beside));
  const Box3 deeper(Vec3(-1, 0.4, 0.9), Vec3(1.1 * kThickness, 0.6, 1.1));
  EXPECT_FALSE(PairHull(source, target, kThickness).misses(deeper));
}

}  // namespace
