#include "radiosity/visibility/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

/// Appends an axis-parallel rectangle a + s u + t v, s, t in [0, 1], facing u x v.
void add_rectangle(PatchMesh& mesh, const Vec3& a, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, a + u, a + u + v, a + v});
  mesh.add_patch({first, first + 1, first + 2, first + 3}, 0,
                 static_cast<std::int32_t>(mesh.size()));
}

PatchMesh opposed_squares_with_screen(double size, const Vec3& origin) {
  PatchMesh mesh;
  add_rectangle(mesh, origin, Vec3(size, 0, 0), Vec3(0, size, 0));
  add_rectangle(mesh, origin + Vec3(0, 0, size), Vec3(0, size, 0), Vec3(size, 0, 0));
  add_rectangle(mesh, origin + Vec3(0, 0, size / 2), Vec3(size / 2, 0, 0), Vec3(0, size, 0));
  return mesh;
}

class VisibilityAtScale : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(VisibilityAtScale, ScreenBlocksItsHalf) {
  const auto [size, offset] = GetParam();
  const Vec3 origin = Vec3::Constant(offset);
  const PatchMesh mesh = opposed_squares_with_screen(size, origin);
  const Visibility visibility(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.001, 0.999);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vec3> from;
    std::vector<Vec3> to;
    std::uint32_t expected = 0;
    for (unsigned k = 0; k < Visibility::kPacket; ++k) {
      const double x0 = uniform(random);
      const double x1 = uniform(random);
      if (std::abs((x0 + x1) / 2 - 0.5) < 1e-3) continue;
      expected |= static_cast<std::uint32_t>((x0 + x1) / 2 < 0.5) << from.size();
      from.push_back(origin + size * Vec3(x0, uniform(random), 0));
      to.push_back(origin + size * Vec3(x1, uniform(random), 1));
    }
    EXPECT_EQ(visibility.blocked(from, to, 0, 1), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, VisibilityAtScale,
                         testing::Values(std::pair{1.0, 0.0}, std::pair{1e-6, 0.0},
                                         std::pair{1e6, 0.0}, std::pair{1.0, 1e7}));

// Float coordinates say little about which way a needle faces: two that see each other do not block
// themselves, whatever their shape.
TEST(Visibility, NeedlesDoNotBlockThemselves) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  int n_rays = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const double width = std::pow(10.0, -6 * uniform(random));
    PatchMesh mesh;
    for (std::int32_t k = 0; k < 2; ++k) {
      const Vec3 a = 2 * k * Vec3::UnitZ() + 0.4 * test::random_unit(random);
      const Vec3 along = test::random_unit(random);
      Vec3 u = along;
      Vec3 v = uniform(random) * along + width * along.cross(test::random_unit(random));
      if ((u.cross(v).z() > 0) != (k == 0)) std::swap(u, v);
      mesh.vertices.insert(mesh.vertices.end(), {a, a + u, a + v});
      mesh.add_patch({3 * k, 3 * k + 1, 3 * k + 2, -1}, 0, k);
    }
    const Visibility visibility(mesh);
    std::vector<Vec3> from;
    std::vector<Vec3> to;
    for (int ray = 0; ray < 400; ++ray) {
      std::array<Vec3, 2> ends;
      for (Index k = 0; k < 2; ++k) {
        const double s = std::sqrt(uniform(random));
        const double t = uniform(random);
        ends[k] = (1 - s) * mesh.corner(k, 0) + s * (1 - t) * mesh.corner(k, 1) +
                  s * t * mesh.corner(k, 2);
      }
      const Vec3 d = ends[1] - ends[0];
      if (mesh.normal[0].dot(d) <= 0 || mesh.normal[1].dot(d) >= 0) continue;
      from.push_back(ends[0]);
      to.push_back(ends[1]);
      ++n_rays;
      if (from.size() < Visibility::kPacket) continue;
      ASSERT_EQ(visibility.blocked(from, to, 0, 1), 0U) << "trial " << trial << ", " << width;
      from.clear();
      to.clear();
    }
  }
  EXPECT_GT(n_rays, 100'000);
}

// A screen of needles hides as much as one of squares.
TEST(Visibility, NeedlesBlockWhatIsBehindThem) {
  PatchMesh mesh;
  test::add_grid(mesh, Vec3(0, 0, 0), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  test::add_grid(mesh, Vec3(0, 0, 1), Vec3::UnitY(), Vec3::UnitX(), 1, 1);
  test::add_grid(mesh, Vec3(0, 0.1, 0.5), 0.5 * Vec3(1, 0.1, 0.2), Vec3(0, 1, 0.1), 1, 2000);
  const Visibility visibility(mesh);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vec3 normal = Vec3(1, 0.1, 0.2).cross(Vec3(0, 1, 0.1));
  int n_blocked = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Vec3 from(uniform(random), uniform(random), 0);
    const Vec3 to(uniform(random), uniform(random), 1);
    const Vec3 corner(0, 0.1, 0.5);
    const double t = normal.dot(corner - from) / normal.dot(to - from);
    const Vec3 hit = from + t * (to - from) - corner;
    const double s = 2 * hit.x();
    const double r = hit.y() - 0.1 * hit.x();
    if (std::min({std::abs(s), std::abs(s - 1), std::abs(r), std::abs(r - 1)}) < 1e-4) continue;
    const bool is_blocked = s > 0 && s < 1 && r > 0 && r < 1;
    n_blocked += is_blocked ? 1 : 0;
    EXPECT_EQ(visibility.blocked(std::array{from}, std::array{to}, 0, 1), is_blocked ? 1U : 0U);
  }
  EXPECT_GT(n_blocked, 1000);
}

TEST(Visibility, PatchesDoNotBlockThemselvesOrTheirPlane) {
  PatchMesh mesh;
  add_rectangle(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  add_rectangle(mesh, Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));  // beside, same plane
  add_rectangle(mesh, Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));  // shares an edge
  const Visibility visibility(mesh);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::array from{Vec3(uniform(random), uniform(random), 0)};
    const std::array to{Vec3(0, uniform(random), uniform(random))};
    EXPECT_EQ(visibility.blocked(from, to, 0, 2), 0U);
  }
}

TEST(Visibility, NothingLeaksThroughSharedEdges) {
  // A screen of 64 x 64 quads between two squares: no segment may slip through at shared edges.
  constexpr int kCells = 64;
  PatchMesh mesh;
  add_rectangle(mesh, Vec3(0.25, 0.25, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0));
  add_rectangle(mesh, Vec3(0.25, 0.25, 1), Vec3(0, 0.5, 0), Vec3(0.5, 0, 0));
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const auto corner = [](int a, int b) {
        return Vec3(a / double(kCells), b / double(kCells), 0.5 + 0.1 * (a * 37 % 11) / 11.0);
      };
      const auto first = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {corner(i, j), corner(i + 1, j),
                                                 corner(i + 1, j + 1), corner(i, j + 1)});
      mesh.add_patch({first, first + 1, first + 2, first + 3}, 0, 0);
    }
  }
  const Visibility visibility(mesh);
  for (int k = 0; k < 20000; ++k) {
    // Aim exactly at vertices and edges of the screen.
    const Vec3 target(double(16 + k % 33) / kCells, 0.25 + 0.5 * (k * 7919 % 20000) / 20000.0, 0);
    const std::array from{Vec3(target.x(), target.y(), 0)};
    const std::array to{Vec3(target.x(), target.y(), 1)};
    ASSERT_EQ(visibility.blocked(from, to, 0, 1), 1U) << target.transpose();
  }
}

TEST(Visibility, FirstHitTellsSideAndDistance) {
  const PatchMesh mesh = opposed_squares_with_screen(1, Vec3::Zero());
  const Visibility visibility(mesh);
  const auto front = visibility.first_hit(Vec3(0.75, 0.5, 0), Vec3(0, 0, 2), 0);
  ASSERT_TRUE(front.has_value());
  EXPECT_EQ(front->patch, 1);
  EXPECT_TRUE(front->front);
  EXPECT_NEAR(front->distance, 1, 1e-6);
  const auto back = visibility.first_hit(Vec3(0.25, 0.5, 0), Vec3(0, 0, 2), 0);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->patch, 2);
  EXPECT_FALSE(back->front);
  EXPECT_FALSE(visibility.first_hit(Vec3(0.5, 0.5, 0), Vec3(0, 0, -1), 0).has_value());
}

TEST(Visibility, FirstHitOfWallsBackToBackIsTheOneThatFacesTheRay) {
  // Two rooms with a wall in common; Embree finds either side of it first.
  for (const bool is_swapped : {false, true}) {
    PatchMesh mesh;
    const Box3 left(Vec3(-1.1, -.7, -.4), Vec3(.1, .8, .9));
    const Box3 right(Vec3(.1, -.7, -.4), Vec3(1.3, .8, .9));
    for (const Box3* box : {is_swapped ? &right : &left, is_swapped ? &left : &right}) {
      test::add_box(mesh, box->min(), box->max(), 3, test::Facing::inwards);
    }
    const Visibility visibility(mesh);
    std::mt19937_64 random(7);
    for (int k = 0; k < 5000; ++k) {
      const auto i = static_cast<std::int32_t>(random() % mesh.size());
      const Vec3 direction = mesh.normal[i] + 0.999 * test::random_unit(random);
      const auto hit = visibility.first_hit(mesh.centroid[i], direction, i);
      ASSERT_TRUE(hit);
      ASSERT_TRUE(hit->front) << "from patch " << i << " along " << direction.transpose();
      ASSERT_EQ(i < mesh.size() / 2, hit->patch < mesh.size() / 2) << "in another room";
    }
  }
}

TEST(Visibility, FirstFrontHitPassesThroughBacks) {
  PatchMesh mesh = opposed_squares_with_screen(1, Vec3::Zero());
  {
    const Visibility visibility(mesh);
    // The screen faces up: from below one looks through it, from above one sees it.
    const auto through = visibility.first_front_hit(Vec3(0.25, 0.5, 0.1), Vec3(0, 0, 1));
    ASSERT_TRUE(through.has_value());
    EXPECT_EQ(through->patch, 1);
    EXPECT_EQ(visibility.first_front_hit(Vec3(0.25, 0.5, 0.9), Vec3(0, 0, -1))->patch, 2);
  }
  // A second polygon in the same place, facing down: now there is something to see from below.
  add_rectangle(mesh, Vec3(0, 0, 0.5), Vec3(0, 1, 0), Vec3(0.5, 0, 0));
  const Visibility visibility(mesh);
  EXPECT_EQ(visibility.first_front_hit(Vec3(0.25, 0.5, 0.1), Vec3(0, 0, 1))->patch, 3);
  EXPECT_EQ(visibility.first_front_hit(Vec3(0.25, 0.5, 0.9), Vec3(0, 0, -1))->patch, 2);
}

TEST(Visibility, EmptyMeshHasNoHits) {
  const Visibility visibility{PatchMesh{}};
  EXPECT_FALSE(visibility.first_hit(Vec3::Zero(), Vec3(1, 0, 0)).has_value());
}

}  // namespace
}  // namespace radiosity
