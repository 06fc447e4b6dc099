/// Form factors past sheets that are close to one of the patches, against sums over many points of
/// the exact form factor from each.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/transport.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visible_polygon.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr double kAsked = 1e-3;
/// Beyond so many standard errors of sixteen means a right value is once in 10,000 times.
constexpr double kSheetSigmas = 5.5;
/// Points of the reference along either side of the source. Where a sheet ends or crosses it, what
/// is seen changes at once along some four lines of the source's length, in rows of points that are
/// half a spacing off at most and a third of that in the root mean square along slanting lines.
constexpr int kPointsAlong = 300;
constexpr double kReferenceError = 4 * 0.5 / (3 * kPointsAlong) / std::numbers::sqrt3 / 2;

/// A parallelogram.
struct Sheet {
  Vec3 corner;
  Vec3 u;
  Vec3 v;
  [[nodiscard]] std::vector<Vec3> corners() const {
    return {corner, corner + u, corner + u + v, corner + v};
  }
};

/// F from the first sheet to the second past the third one.
double factor_by_points(const std::array<Sheet, 3>& sheets) {
  const auto& [source, target, blocker] = sheets;
  Occluder occluder;
  occluder.normal = blocker.u.cross(blocker.v).normalized();
  occluder.offset = occluder.normal.dot(blocker.corner);
  occluder.corners = blocker.corners();
  const Occluder* const occluders = &occluder;
  const Vec3 normal = source.u.cross(source.v).normalized();
  const ConvexPolygon all(target.corners());
  double sum = 0;
  for (int k = 0; k < square(kPointsAlong); ++k) {
    const double s = (k % kPointsAlong + 0.5) / kPointsAlong;
    const double t = (k / kPointsAlong + 0.5) / kPointsAlong;
    const Vec3 point = source.corner + s * source.u + t * source.v;
    const ConvexPolygon seen = clip_to_half_space(all.points(), point, normal, 0);
    if (seen.size() >= 3) sum += visible_point_to_polygon(point, normal, seen, {&occluders, 1}, 0);
  }
  return sum / square(kPointsAlong);
}

/// `others` are in nobody's way.
void expect_right(const std::array<Sheet, 3>& sheets, const std::vector<Sheet>& others = {}) {
  PatchMesh mesh;
  for (const Sheet& sheet : sheets) test::add_grid(mesh, sheet.corner, sheet.u, sheet.v, 1, 1);
  for (const Sheet& sheet : others) test::add_grid(mesh, sheet.corner, sheet.u, sheet.v, 1, 1);
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = kAsked, .closed = Closed::no});
  const double factor = rows_of(*transport).row(0)[1];
  const double error = rows_of(*transport).row_error(0)[1];
  const double expected = factor_by_points(sheets);
  EXPECT_GE(factor, 0);
  EXPECT_NEAR(factor, expected, kAsked + kReferenceError);
  EXPECT_NEAR(factor, expected, kSheetSigmas * error + kReferenceError) << "error " << error;
}

/// A sheet of size 1 about (x, y, height), turned about the vertical and a little tilted.
Sheet tilted(double x, double y, double height, double tilt, std::mt19937_64& random) {
  std::uniform_real_distribution<double> slope(-tilt, tilt);
  // Not along the rows of the reference's points.
  const double angle = std::uniform_real_distribution<double>(0.2, 0.7)(random);
  const Vec3 u(std::cos(angle), std::sin(angle), slope(random));
  const Vec3 v(-std::sin(angle), std::cos(angle), slope(random));
  return {Vec3(x, y, height) - 0.5 * (u + v), u, v};
}

TEST(CloseSheets, HideWhatTheyHideHoweverClose) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  std::uniform_real_distribution<double> distance(0.05, 0.4);
  std::uniform_real_distribution<double> power(-5, -1.5);
  for (int k = 0; k < 24; ++k) {
    SCOPED_TRACE(k);
    const Sheet source{Vec3(-0.5, -0.5, 0), Vec3::UnitX(), Vec3::UnitY()};
    Sheet target = tilted(shift(random), shift(random), distance(random), 0.02, random);
    std::swap(target.u, target.v);
    const double height = std::pow(10, power(random));
    const double tilt = std::pow(10, power(random));
    expect_right({source, target, tilted(shift(random), shift(random), height, tilt, random)});
  }
}

TEST(CloseSheets, HideWhatTheyHideFromPatchesOfAMillionth) {
  constexpr double kSmall = 2e-6;
  // Beside what these exchange the small one may be off by much, so that rays would do.
  const std::vector<Sheet> large{{Vec3(2, -0.5, 0), Vec3::UnitY(), Vec3::UnitZ()},
                                 {Vec3(3, -0.5, 0), Vec3::UnitZ(), Vec3::UnitY()}};
  for (const double edge : {0.3, 0.45, 0.6}) {
    for (const double height : {0.1, 0.2, 0.4}) {
      SCOPED_TRACE(testing::Message() << edge << ' ' << height);
      const Sheet source{Vec3::Zero(), kSmall * Vec3::UnitX(), kSmall * Vec3::UnitY()};
      const Sheet target{Vec3(-0.06, -0.06, 1), 0.12 * Vec3::UnitY(), 0.12 * Vec3::UnitX()};
      const Sheet rising{kSmall * Vec3(edge, -2, height), 5 * kSmall * Vec3::UnitY(),
                         5 * kSmall * Vec3(-0.5, 0, 0.9)};
      expect_right({source, target, rising}, large);
    }
  }
}

// So much stands about that rays are cast before anything is proved, which begin above the carpet.
TEST(CloseSheets, CoverAFloorAmongClutter) {
  for (const double gap : {1e-7, 3e-6}) {
    std::mt19937_64 random(11);
    PatchMesh mesh;
    test::add_box(mesh, Vec3::Zero(), Vec3(5, 5, 3), 5, test::Facing::inwards);
    const auto n_room = mesh.size();
    test::make_two_sided(mesh,
                         test::add_grid(mesh, Vec3(1, 1, gap), Vec3(0, 3, 0), Vec3(3, 0, 0), 1, 1));
    const auto n_carpeted = mesh.size();
    for (int k = 0; k < 16; ++k) {
      const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
      };
      const Vec3 middle(between(0.3, 4.7), between(0.3, 4.7), between(0.5, 2.5));
      const Vec3 half(between(0.05, 0.25), between(0.05, 0.25), between(0.05, 0.25));
      test::add_box(mesh, middle - half, middle + half, 1, test::Facing::outwards);
    }
    const Visibility visibility(mesh);
    const auto transport =
        make_dense_transport(mesh, visibility, {.tolerance = 1e-2, .closed = Closed::no});
    int n_covered = 0;
    for (Index i = 0; i < n_room; ++i) {
      const Vec3 middle = mesh.centroid[i] - Vec3(2.5, 2.5, 0);
      if (middle.cwiseAbs().maxCoeff() > 1.5 || mesh.normal[i].z() < 0.5) continue;
      ++n_covered;
      const Eigen::VectorXd row = rows_of(*transport).row(i);
      const double to_carpet = row.segment(n_room, n_carpeted - n_room).sum();
      // All else is seen past the carpet's edges: through a gap that high about 9 patches of 1 m².
      EXPECT_NEAR(to_carpet, 1, 12 * gap);
      EXPECT_LE(row.sum() - to_carpet, 12 * gap);
    }
    EXPECT_EQ(n_covered, 9);
  }
}

}  // namespace
}  // namespace radiosity
