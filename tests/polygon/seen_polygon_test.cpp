// Directions towards polygons, and segments of touching patches that are even in them.
#include "radiosity/polygon/seen_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using Polygon = std::vector<Vec3>;
constexpr int kCells = 200;

const Polygon kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Polygon kPentagon{{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {1, 2, 0}, {-0.5, 1, 0}};

/// The mean of f over directions of even density in solid angle, times the solid angle.
template <typename Function>
double integral(const SeenPolygon& seen, const Function& f) {
  double sum = 0;
  for (int k = 0; k < kCells; ++k) {
    for (int m = 0; m < kCells; ++m) {
      sum += f(seen.direction((k + 0.5) / kCells, (m + 0.5) / kCells));
    }
  }
  return sum / (kCells * kCells) * seen.solid_angle();
}

TEST(SeenPolygon, HasTheSolidAngleOfAFaceOfACube) {
  const SeenPolygon seen({0.5, 0.5, 0.5}, ConvexPolygon(kSquare));
  EXPECT_NEAR(seen.solid_angle(), 4 * std::numbers::pi / 6, 1e-14);
  EXPECT_EQ(SeenPolygon({3, 0.5, 0}, ConvexPolygon(kSquare)).solid_angle(), 0);  // edge-on
}

// ∫ cosθ dω / π is the form factor of a point in closed form (Lambert 1760), near and far.
TEST(SeenPolygon, DirectionsIntegrateToTheFormFactorOfAPoint) {
  for (const Polygon& polygon : {kSquare, kPentagon}) {
    for (const double height : {1e-3, 0.1, 1.0, 30.0}) {
      const Vec3 point(0.3, 0.6, height);
      const SeenPolygon seen(point, ConvexPolygon(polygon));
      for (const Vec3& normal : {Vec3(0, 0, -1), Vec3(0.6, 0, -0.8)}) {
        const double factor =
            integral(seen, [&](const Vec3& way) { return std::max(0.0, way.dot(normal)); }) /
            std::numbers::pi;
        const double exact = point_to_polygon(point, normal, polygon);
        EXPECT_NEAR(factor, exact, 2e-3 * exact) << "height " << height;
      }
    }
  }
}

TEST(SeenPolygon, DirectionsMeetThePolygon) {
  const Vec3 point(1.9, -0.4, 0.02);
  const SeenPolygon seen(point, ConvexPolygon(kPentagon));
  integral(seen, [&](const Vec3& way) {
    EXPECT_NEAR(way.norm(), 1, 1e-12);
    const Vec3 met = point - point.z() / way.z() * way;
    for (std::size_t k = 0; k < kPentagon.size(); ++k) {
      const Vec3& a = kPentagon[k];
      const Vec3& b = kPentagon[(k + 1) % kPentagon.size()];
      EXPECT_GE((b - a).cross(met - a).z(), -1e-9);
    }
    return 0.0;
  });
}

// A wall on a floor, whose kernel is singular where they touch, and a screen parallel to the wall
// that stands on the floor: it halves the wall's view of what is behind it.
TEST(FractionSampler, IsRightForPatchesThatTouch) {
  PatchMesh mesh;
  const auto add = [&](const Polygon& p, int surface) {
    std::array<std::int32_t, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.push_back(p[k]);
    }
    mesh.surface_names.push_back(std::to_string(surface));
    mesh.add_patch(corners, surface, surface);
  };
  constexpr double kScreen = 0.4;
  constexpr double kTop = 0.25;
  add({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);                                // floor
  add({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 1);                                // wall
  add({{kScreen, 0, 0}, {kScreen, 0, kTop}, {kScreen, 1, kTop}, {kScreen, 1, 0}}, 2);  // screen
  const Visibility visibility(mesh);

  // From each point of the floor behind the screen the wall is seen above a line.
  const auto wall_above = [](double z) {
    return Polygon{{0, 0, z}, {0, 1, z}, {0, 1, 1}, {0, 0, 1}};
  };
  constexpr int kSteps = 4000;
  double behind = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double x = kScreen + (1 - kScreen) * (k + 0.5) / kSteps;
    const double z = kTop * x / (x - kScreen);
    if (z >= 1) continue;
    // The strip at x sees the wall's part: exchange by Lambert's factor at points along it.
    constexpr int kAcross = 40;
    for (int m = 0; m < kAcross; ++m) {
      behind += point_to_polygon({x, (m + 0.5) / kAcross, 0}, {0, 0, 1}, wall_above(z)) *
                (1 - kScreen) / (kSteps * kAcross);
    }
  }
  const Polygon front{{0, 0, 0}, {kScreen, 0, 0}, {kScreen, 1, 0}, {0, 1, 0}};
  const double before = exchange_area(front, wall_above(0));
  const double whole = exchange_area(kSquare, wall_above(0));
  const double expected = (before + behind) / whole;

  const ConvexPolygon floor(kSquare);
  const ConvexPolygon wall(wall_above(0));
  const Vec3& center = visibility.center();
  ConvexPolygon floor_local;
  ConvexPolygon wall_local;
  for (const Vec3& p : floor) floor_local.push_back(p - center);
  for (const Vec3& p : wall) wall_local.push_back(p - center);
  const HalfSpace floor_plane{{0, 0, 1}, -center.z()};
  const HalfSpace wall_plane{{1, 0, 0}, -center.x()};
  const SampledPair pair{floor_local, floor_plane, wall_local, wall_plane, 0, 1};
  constexpr int kSeeds = 40;
  int within_two = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const PairEstimate fraction = sample_visible_fraction(
        visibility, pair, {2e-3, 1 << 16}, static_cast<std::uint64_t>(seed), Sampling::directions);
    EXPECT_NEAR(fraction.value, expected, 5 * fraction.error);
    EXPECT_LE(fraction.error, 2e-3);
    EXPECT_LE(fraction.rays, 8000);
    within_two += std::abs(fraction.value - expected) <= 2 * fraction.error ? 1 : 0;
  }
  EXPECT_GE(within_two, kSeeds * 9 / 10);
}

}  // namespace
}  // namespace radiosity
