/// What proofs rest on: contact judged alike from both ends, bodies around and within others,
/// pieces of surface, and what solids cover.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "radiosity/assembly/balance.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/surface_pieces.h"
#include "radiosity/scene/winding.h"
#include "radiosity/visibility/blocker_set.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/polytope.h"
#include "radiosity/visibility/segment_bundle.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::add_box;
using test::add_grid;
using test::Facing;

constexpr std::uint64_t kSeed = 411;
constexpr double kThickness = 1e-11;

/// Sets of eight corners are boxes here, those of fewer polygons.
SegmentBundle bundle(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return {{a, a.size() < 8}, {b, b.size() < 8}, kThickness};
}

std::vector<Vec3> box_corners(const Vec3& low, const Vec3& high) {
  const Box3 box(low, high);
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) corners.push_back(box.corner(static_cast<Box3::CornerType>(k)));
  return corners;
}

/// The one blocker of a mesh of which the walls of a room, in outer planes, are the rest.
Blocker only_blocker(const PatchMesh& mesh) {
  const BlockerSet set = make_blockers(mesh, kThickness);
  EXPECT_EQ(set.blockers.size(), 1U);
  return set.blockers.at(0);
}

PatchMesh room() {
  PatchMesh mesh;
  add_box(mesh, {-2, -2, -2}, {2, 2, 2}, 1, Facing::inwards);
  return mesh;
}

TEST(SegmentBundle, ABoxThatTouchesAPolygonFromBehindIsNotHidden) {
  PatchMesh mesh = room();
  add_grid(mesh, {-1, -1, 0}, Vec3::UnitX() * 2, Vec3::UnitY() * 2, 1, 1);
  const Blocker plate = only_blocker(mesh);
  // The set behind holds what lies in the plate itself and looks at the set in front.
  const std::vector<Vec3> behind = box_corners({-.2, -.2, -.5}, {.2, .2, 0});
  const std::vector<Vec3> in_front = box_corners({-.1, -.1, 1}, {.1, .1, 1.2});
  for (const auto& [a, b] : {std::pair(&behind, &in_front), {&in_front, &behind}}) {
    EXPECT_EQ(bundle(*a, *b).test(plate).blocking, Blocking::some);
  }
  const std::vector<Vec3> further = box_corners({-.2, -.2, -.5}, {.2, .2, -.01});
  for (const auto& [a, b] : {std::pair(&further, &in_front), {&in_front, &further}}) {
    EXPECT_EQ(bundle(*a, *b).test(plate).blocking, Blocking::all);
  }
}

TEST(SegmentBundle, APatchIsFlatHoweverItsCornersAreRounded) {
  PatchMesh mesh = room();
  add_grid(mesh, {-1, -1, 0}, Vec3::UnitX() * 2, Vec3::UnitY() * 2, 1, 1);
  const Blocker plate = only_blocker(mesh);
  // The plane through its first three corners is far off the fourth.
  const double off = 0.9 * kThickness;
  const std::vector<Vec3> below{{0, 0, -.5}, {1e-4, 0, -.5 + off}, {1e-4, 1e-4, -.5}, {0, .2, -.5}};
  const std::vector<Vec3> above{{0, 0, .5}, {.2, 0, .5}, {.2, .2, .5}, {0, .2, .5}};
  for (const auto& [a, b] : {std::pair(&below, &above), {&above, &below}}) {
    Shadow shadow;
    EXPECT_EQ(bundle(*a, *b).test(plate, &shadow).blocking, Blocking::all);
  }
  const std::vector<Vec3> beside{{.9, 0, .5}, {1.2, 0, .5}, {1.2, .2, .5}, {.9, .2, .5}};
  const std::vector<Vec3> touching{{0, 0, 0}, {1e-4, 0, -off}, {1e-4, 1e-4, 0}, {0, .2, 0}};
  // What lies in a polygon's plane is not hidden by it, and what is partly hidden has a border.
  EXPECT_EQ(bundle(touching, above).test(plate).blocking, Blocking::none);
  const std::vector<Vec3> near{
      {.9, 0, -.1}, {.9 + 1e-4, 0, -.1 + off}, {1.1, .2, -.1}, {.9, .2, -.1}};
  Shadow shadow;
  EXPECT_EQ(bundle(near, beside).test(plate, &shadow).blocking, Blocking::some);
  EXPECT_FALSE(shadow.edges.empty());
}

/// A convex set of corners somewhere about a place: a box or a polygon.
std::vector<Vec3> random_set(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  std::uniform_int_distribution<int> coin(0, 1);
  const Vec3 center(uniform(random), uniform(random), uniform(random));
  if (coin(random) == 0) {
    const Vec3 half = Vec3(uniform(random), uniform(random), uniform(random)).cwiseAbs() * 0.2;
    return box_corners(center - half, center + half);
  }
  const Vec3 u = 0.3 * test::random_unit(random);
  const Vec3 v = 0.3 * test::random_unit(random);
  return {center, center + u, center + v};
}

TEST(SegmentBundle, VerdictsAreTrueAndDoNotDependOnTheOrder) {
  PatchMesh mesh = room();
  add_box(mesh, {-.4, -.3, -.5}, {.5, .4, .3}, 2, Facing::outwards);
  const Blocker body = only_blocker(mesh);
  ASSERT_EQ(body.faces.size(), 6U);
  ASSERT_EQ(body.edges.size(), 12U);
  std::mt19937_64 random(kSeed);
  std::array<int, 3> count{};
  for (int k = 0; k < 20000; ++k) {
    const std::vector<Vec3> a = random_set(random);
    const std::vector<Vec3> b = random_set(random);
    const Blocking verdict = bundle(a, b).test(body).blocking;
    EXPECT_EQ(verdict, bundle(b, a).test(body).blocking) << kSeed << ", " << k;
    ++count[static_cast<std::size_t>(verdict)];
    if (verdict == Blocking::some) continue;
    for (int ray = 0; ray < 8; ++ray) {
      const Vec3 from = test::random_point(a, random);
      const Vec3 to = test::random_point(b, random);
      const double inside = test::length_inside(body.faces, from, to);
      // What is inside with both ends crosses no face.
      const bool is_blocked = inside > 1e-9 && inside < 1 - 1e-9;
      EXPECT_EQ(is_blocked, verdict == Blocking::all) << kSeed << ", " << k;
    }
  }
  EXPECT_GT(count[static_cast<std::size_t>(Blocking::none)], 1000);
  EXPECT_GT(count[static_cast<std::size_t>(Blocking::all)], 100);
  EXPECT_GT(count[static_cast<std::size_t>(Blocking::some)], 1000);
}

TEST(Polytope, HoldsItsPointsAndTellsSegmentsApart) {
  std::mt19937_64 random(kSeed);
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) points.push_back(0.7 * test::random_unit(random));
  const std::optional<Blocker> body = enclosing_polytope(points);
  ASSERT_TRUE(body);
  for (const HalfSpace& face : body->faces) {
    for (const Vec3& point : points) EXPECT_LE(face.normal.dot(point), face.offset + 1e-12);
    for (const Vec3& corner : body->corners) EXPECT_LE(face.normal.dot(corner), face.offset + 1e-9);
  }
  for (int k = 0; k < 5000; ++k) {
    const std::vector<Vec3> a = random_set(random);
    const std::vector<Vec3> b = random_set(random);
    if (!bundle(a, b).misses(*body)) continue;
    for (int ray = 0; ray < 8; ++ray) {
      EXPECT_LE(test::length_inside(body->faces, test::random_point(a, random),
                                    test::random_point(b, random)),
                1e-9)
          << kSeed << ", " << k;
    }
  }
}

TEST(Polytope, IsPiercedByAllSegmentsOrNot) {
  std::mt19937_64 random(kSeed);
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) points.push_back(0.7 * test::random_unit(random));
  const Blocker body = shrunk(enclosing_polytope(points).value(), Vec3::Zero(), 0.9);
  int n_pierced = 0;
  for (int k = 0; k < 20000; ++k) {
    const std::vector<Vec3> a = random_set(random);
    const std::vector<Vec3> b = random_set(random);
    if (!bundle(a, b).is_pierced(body)) continue;
    ++n_pierced;
    for (int ray = 0; ray < 8; ++ray) {
      EXPECT_GT(test::length_inside(body.faces, test::random_point(a, random),
                                    test::random_point(b, random)),
                0)
          << kSeed << ", " << k;
    }
  }
  EXPECT_GT(n_pierced, 200);
}

std::vector<std::int32_t> all_patches(const PatchMesh& mesh) {
  std::vector<std::int32_t> all(mesh.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(SurfacePieces, SolidsThatTouchAtAnEdgeAreTold) {
  PatchMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 1, 1}, 1, Facing::outwards);
  add_box(mesh, {1, 1, 0}, {2, 2, 1}, 1, Facing::outwards);  // shares the edge x = y = 1
  add_box(mesh, {-3, -3, -3}, {3, 3, 3}, 1, Facing::inwards);
  const SurfacePieces pieces = find_surface_pieces(mesh, all_patches(mesh), kThickness);
  ASSERT_EQ(pieces.pieces.size(), 3U);
  EXPECT_TRUE(pieces.pieces[0].is_solid());
  EXPECT_TRUE(pieces.pieces[1].is_solid());
  EXPECT_TRUE(pieces.pieces[2].is_hollow());
  EXPECT_NEAR(pieces.pieces[0].volume, 1, 1e-14);
  EXPECT_EQ(winding_number(pieces, pieces.pieces[0], {.5, .5, .5}), 1);
  EXPECT_EQ(winding_number(pieces, pieces.pieces[2], {.5, .5, .5}), -1);
  EXPECT_EQ(winding_number(pieces, pieces.pieces[0], {1.5, 1.5, .5}), 0);
}

/// Appends patches of one mesh to another.
void append(PatchMesh& mesh, const PatchMesh& other, Index first, Index last) {
  const auto offset = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Index i = first; i < last; ++i) {
    std::array<std::int32_t, 4> corners = other.corners[i];
    for (std::int32_t& corner : corners) corner += corner >= 0 ? offset : 0;
    mesh.add_patch(corners, 0, static_cast<std::int32_t>(mesh.size()));
  }
}

// As adaptive refinement leaves them: a box whose faces have corners within their neighbours'
// edges.
TEST(SurfacePieces, HangTogetherHoweverTheyAreDivided) {
  PatchMesh coarse;
  PatchMesh fine;
  add_box(coarse, {1, 1, 0}, {2, 3, 1}, 1, Facing::outwards);
  add_box(fine, {1, 1, 0}, {2, 3, 1}, 3, Facing::outwards);
  PatchMesh mesh;
  add_box(mesh, {0, 0, 0}, {4, 4, 4}, 1, Facing::inwards);
  append(mesh, coarse, 0, 2);
  append(mesh, fine, 18, 36);
  append(mesh, coarse, 4, 6);
  const SurfacePieces pieces = find_surface_pieces(mesh, all_patches(mesh), kThickness);
  ASSERT_EQ(pieces.pieces.size(), 2U);
  EXPECT_TRUE(pieces.pieces[1].is_solid());
  EXPECT_NEAR(pieces.pieces[1].volume, 2, 1e-14);
  const Coverage coverage = find_coverage(mesh, kThickness);
  EXPECT_NEAR(coverage.share[0], 2.0 / 16, 1e-9);  // the floor, under the box
  EXPECT_EQ(coverage.share[6], 1);                 // the box's bottom
  const BlockerSet blockers = make_blockers(mesh, kThickness);
  EXPECT_EQ(std::count_if(blockers.blockers.begin(), blockers.blockers.end(),
                          [](const Blocker& b) { return !b.is_flat(); }),
            1);
}

// The floor under a box and its bottom in one patch each, all about them in three: what is divided
// alike need not hang together.
TEST(SurfacePieces, HangTogetherWhereTwoAreDividedAlike) {
  PatchMesh mesh;
  const auto add_floor = [&](double x, double y, double width, double depth, int nx, int ny) {
    test::add_grid(mesh, Vec3(x, y, 0), width * Vec3::UnitX(), depth * Vec3::UnitY(), nx, ny);
  };
  add_floor(1, 1, 1, 2, 1, 1);
  add_floor(0, 1, 1, 2, 1, 3);
  add_floor(2, 1, 2, 2, 1, 3);
  add_floor(1, 0, 1, 1, 3, 1);
  add_floor(1, 3, 1, 1, 3, 1);
  for (const double x : {0, 2}) {
    for (const double y : {0, 3}) add_floor(x, y, x == 0 ? 1 : 2, 1, 1, 1);
  }
  const auto n_floor = mesh.size();
  PatchMesh room;
  PatchMesh coarse;
  PatchMesh fine;
  add_box(room, {0, 0, 0}, {4, 4, 4}, 1, Facing::inwards);
  add_box(coarse, {1, 1, 0}, {2, 3, 1}, 1, Facing::outwards);
  add_box(fine, {1, 1, 0}, {2, 3, 1}, 3, Facing::outwards);
  append(mesh, room, 1, 6);
  append(mesh, coarse, 0, 1);
  append(mesh, fine, 9, 54);
  const SurfacePieces pieces = find_surface_pieces(mesh, all_patches(mesh), kThickness);
  ASSERT_EQ(pieces.pieces.size(), 2U);
  EXPECT_TRUE(pieces.pieces[0].is_hollow());
  EXPECT_TRUE(pieces.pieces[1].is_solid());
  EXPECT_NEAR(pieces.pieces[1].volume, 2, 1e-14);
  const Coverage coverage = find_coverage(mesh, kThickness);
  EXPECT_EQ(coverage.share[0], 1);            // the floor under the box
  EXPECT_EQ(coverage.share[n_floor + 5], 1);  // the box's bottom
  EXPECT_NEAR(coverage.share.sum(), 2, 1e-9);
}

TEST(Coverage, OfABoxOnAFloorAndAgainstAnother) {
  PatchMesh mesh;
  add_box(mesh, {0, 0, 0}, {4, 4, 4}, 1, Facing::inwards);          // patches 0 to 5
  add_box(mesh, {1, 1, 0}, {2, 3, 1}, 1, Facing::outwards);         // 6 to 11, stands on the floor
  add_box(mesh, {2, 1, 0.5}, {2.5, 2, 0.75}, 1, Facing::outwards);  // 12 to 17, touches its side
  const Coverage coverage = find_coverage(mesh, 1e-10);
  std::vector<double> expected(18, 0.0);
  expected[0] = 2.0 / 16;  // the floor, under the box
  expected[6] = 1;         // the box's bottom on the floor
  expected[9] = 0.25 / 2;  // its side, behind the smaller one
  expected[14] = 1;        // the smaller one's end
  for (Index i = 0; i < 18; ++i) EXPECT_NEAR(coverage.share[i], expected[i], 1e-9) << i;
}

// A cube in a corner of a room that touches nothing but walls and other cubes.
TEST(Coverage, OfABoxThatIsWalledIn) {
  PatchMesh mesh;
  add_box(mesh, {0, 0, 0}, {3, 3, 3}, 1, Facing::inwards);
  for (const Vec3& low : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    add_box(mesh, low, low + Vec3::Ones(), 1, Facing::outwards);
  }
  const Coverage coverage = find_coverage(mesh, 1e-10);
  for (const Index wall : {0, 2, 4}) EXPECT_NEAR(coverage.share[wall], 3.0 / 9, 1e-9) << wall;
  for (Index i = 6; i < 12; ++i) EXPECT_EQ(coverage.share[i], 1) << i;
}

TEST(Coverage, WallsBackToBackCoverNothing) {
  PatchMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 1, 1}, 2, Facing::inwards);
  add_box(mesh, {1, 0, 0}, {2, 1, 1}, 2, Facing::inwards);
  EXPECT_EQ(find_coverage(mesh, 1e-10).share.maxCoeff(), 0);
  EXPECT_EQ(make_blockers(mesh, 1e-10).blockers.size(), 1U);
  // Nor do the walls of a room and the shell around it cover each other.
  PatchMesh shell;
  add_box(shell, {0, 0, 0}, {1, 1, 1}, 2, Facing::inwards);
  add_box(shell, {0, 0, 0}, {1, 1, 1}, 2, Facing::outwards);
  EXPECT_EQ(find_coverage(shell, 1e-10).share.maxCoeff(), 0);
}

TEST(Blockers, AreAsManyHoweverTheSceneIsDivided) {
  for (const int n : {1, 4, 9}) {
    PatchMesh mesh = room();
    add_box(mesh, {-.4, -.3, -.5}, {.5, .4, .3}, n, Facing::outwards);
    add_grid(mesh, {-1, -1, 1}, Vec3::UnitX() * 2, Vec3::UnitY() * 2, n, n);
    EXPECT_EQ(make_blockers(mesh, kThickness).blockers.size(), 2U) << n;
  }
}

/// The same pair moved by what single precision may cost: edges that were parallel and coincided
/// are so no longer.
TEST(ExchangeArea, OfAWallOnAFloorKeepsItsValueWhenRounded) {
  std::mt19937_64 random(kSeed);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Quaterniond turn(Eigen::Vector4d(Eigen::Vector4d::Random()).normalized());
    std::vector<Vec3> floor{{-1, 0, 0}, {1, 0, 0}, {1, 1.5, 0}, {-1, 1.5, 0}};
    std::vector<Vec3> wall{{-.4, .3, 0}, {-.4, .3, .8}, {.5, .3, .8}, {.5, .3, 0}};
    std::vector<Vec3> rounded_floor;
    std::vector<Vec3> rounded_wall;
    for (const Vec3& p : floor) {
      rounded_floor.emplace_back((turn * p).cast<float>().cast<double>());
    }
    for (const Vec3& p : wall) {
      rounded_wall.emplace_back((turn * p).cast<float>().cast<double>());
    }
    const double exact = exchange_area(floor, wall);
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      EXPECT_NEAR(exchange_area(rounded_floor, rounded_wall, tolerance), exact, 1e-5 * exact);
      EXPECT_NEAR(exchange_area(rounded_wall, rounded_floor, tolerance), exact, 1e-5 * exact);
    }
  }
}

/// Two rows that share their only uncertain entry and lack different amounts.
class SharedEntry final : public AdjustableExchange {
 public:
  [[nodiscard]] Index size() const override { return 2; }
  [[nodiscard]] Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const override {
    return kWeight * x.reverse();
  }
  [[nodiscard]] Eigen::VectorXd row_sums() const override {
    return Eigen::Vector2d(1 - 1e-9 + change, 1 - 3e-9 + change);
  }
  void adjust(const Eigen::VectorXd& mu) override { change += kWeight * mu.sum(); }
  [[nodiscard]] double rounding() const override { return 1e-16; }

  static constexpr double kWeight = 1e-24;
  double change = 0;
};

TEST(Balance, EndsWhereRowsCannotBeToldApart) {
  SharedEntry exchange;
  RowSums sums{exchange.row_sums(), Eigen::VectorXd::Ones(2), Eigen::VectorXd::Ones(2)};
  balance_rows(exchange, sums);
  EXPECT_NEAR(exchange.change, 2e-9, 1e-9);
}

}  // namespace
