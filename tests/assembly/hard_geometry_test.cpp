/// Form factors of geometry that is awkward: crossing, coplanar, thin, tiny, huge, far away.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshing/inspect/inspect.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/exchange/sampled_destinations.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/operator/transport.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/scene/patch_mesh.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;

/// Relative error asked of the form factors, and so of row sums.
constexpr double kHardTolerance = 1e-3;
/// Beyond so many standard errors of sixteen means a right value is once in 10,000 times.
constexpr double kSigmas = 5.5;
/// Relative error of the kernel where visibility is proved, with room for sums.
constexpr double kKernel = 1e-7;
/// tests/data/form-factors.json: opposed unit squares at distance 1.
constexpr double kOpposed = 0.199824895698387383;

/// A mesh with the form factors of its patches.
struct Solved {
  explicit Solved(PatchMesh patches)
      : mesh(std::move(patches)),
        visibility(mesh),
        transport(make_dense_transport(mesh, visibility,
                                       {.tolerance = kHardTolerance, .closed = Closed::no})) {}

  [[nodiscard]] Eigen::MatrixXd factors() const {
    Eigen::MatrixXd rows(mesh.size(), mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) rows.row(i) = rows_of(*transport).row(i);
    return rows;
  }
  [[nodiscard]] Eigen::MatrixXd errors() const {
    Eigen::MatrixXd rows(mesh.size(), mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) rows.row(i) = rows_of(*transport).row_error(i);
    return rows;
  }
  [[nodiscard]] Eigen::MatrixXd exchange() const {
    return Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size()).asDiagonal() *
           factors();
  }

  PatchMesh mesh;
  Visibility visibility;
  std::unique_ptr<Transport> transport;
};

/// Finite, not negative, reciprocal, and no more than 1 in a row but for errors.
void expect_sane(const Solved& solved) {
  const Eigen::MatrixXd factors = solved.factors();
  const Eigen::MatrixXd exchange = solved.exchange();
  EXPECT_TRUE(factors.allFinite());
  EXPECT_TRUE(solved.errors().allFinite());
  EXPECT_GE(factors.minCoeff(), 0);
  EXPECT_LE((exchange - exchange.transpose()).cwiseAbs().maxCoeff(), 1e-15 * exchange.maxCoeff());
  for (Index i = 0; i < factors.rows(); ++i) {
    EXPECT_LE(factors.row(i).sum(), 1 + kHardTolerance) << i;
  }
}

/// Row sums of 1, as in closed scenes.
void expect_closed(const Solved& solved) {
  for (Index i = 0; i < solved.mesh.size(); ++i) {
    EXPECT_NEAR(rows_of(*solved.transport).row(i).sum(), 1, kHardTolerance) << i;
  }
}

/// Agreement with the means of exact point factors, surface by surface.
void expect_agreement_with_points(const Solved& solved) {
  const Eigen::MatrixXd factors = surface_form_factors(solved.mesh, *solved.transport);
  const Eigen::MatrixXd errors = surface_form_factor_errors(solved.mesh, *solved.transport);
  for (std::int32_t s = 0; s < factors.rows(); ++s) {
    const DestinationEstimate points = sampled_destinations(solved.mesh, s, {.n_points = 256});
    for (Index t = 0; t < factors.cols(); ++t) {
      const double sigma = std::hypot(errors(s, t), points.error.surfaces[t]);
      EXPECT_NEAR(factors(s, t), points.value.surfaces[t], kSigmas * sigma + kKernel)
          << s << " to " << t;
    }
  }
}

std::vector<Vec3> outline(const PatchMesh& mesh, Index i) {
  std::vector<Vec3> points;
  for (int k = 0; k < mesh.n_corners(i); ++k) points.push_back(mesh.corner(i, k));
  return points;
}

PatchMesh room(int n) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), n, Facing::inwards);
  return mesh;
}

/// A room with a box in it, scaled and moved.
PatchMesh furnished_room(double scale, const Vec3& offset) {
  PatchMesh mesh;
  const auto place = [&](const Vec3& point) { return Vec3(scale * point + offset); };
  add_box(mesh, place(Vec3::Zero()), place(Vec3(1, 1.1, 0.9)), 3, Facing::inwards);
  add_box(mesh, place(Vec3(0.35, 0.3, 0.25)), place(Vec3(0.65, 0.6, 0.7)), 2, Facing::outwards);
  return mesh;
}

PatchMesh triangles(const std::vector<Vec3>& vertices,
                    const std::vector<std::array<std::int32_t, 4>>& corners) {
  PatchMesh mesh;
  mesh.vertices = vertices;
  for (const auto& patch : corners) {
    const auto k = static_cast<std::int32_t>(mesh.size());
    mesh.surface_names.push_back("triangle " + std::to_string(k));
    mesh.surface_two_sided.push_back(false);
    mesh.add_patch(patch, k, k);
  }
  return mesh;
}

TEST(HardGeometry, PlatesThatCrossInARoom) {
  PatchMesh mesh = room(2);
  test::make_two_sided(
      mesh, add_grid(mesh, Vec3(0.2, 0.3, 0.2), Vec3(0.6, 0, 0.5), Vec3(0, 0.4, 0), 1, 1));
  test::make_two_sided(
      mesh, add_grid(mesh, Vec3(0.2, 0.2, 0.7), Vec3(0.6, 0.1, -0.5), Vec3(0, 0.5, 0.1), 1, 1));
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  expect_closed(solved);
  expect_agreement_with_points(solved);
}

TEST(HardGeometry, PlateThroughTheFloor) {
  // What hangs below sees the floor's back and the sky.
  PatchMesh mesh = room(2);
  test::make_two_sided(
      mesh, add_grid(mesh, Vec3(0.3, 0.5, -0.3), Vec3(0.4, 0.1, 0), Vec3(0, 0, 0.8), 1, 1));
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  expect_agreement_with_points(solved);
}

TEST(HardGeometry, FrontsThatOverlapInOnePlaneBothCount) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  add_grid(mesh, Vec3(0.2, 0.3, 1), Vec3(0, 0.5, 0), Vec3(0.4, 0, 0), 1, 1);
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  const double lamp = exchange_area(outline(solved.mesh, 0), outline(solved.mesh, 2));
  EXPECT_NEAR(solved.factors()(0, 1), kOpposed, kKernel);
  EXPECT_NEAR(solved.factors()(0, 2), lamp, kKernel);
  EXPECT_EQ(solved.factors()(1, 2), 0);
}

TEST(HardGeometry, NeighboursInOnePlane) {
  // Two tiles side by side, one of them two-sided, between two squares.
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  test::make_two_sided(mesh, add_grid(mesh, Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1));
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  add_grid(mesh, Vec3(1, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  const Eigen::MatrixXd factors = surface_form_factors(solved.mesh, *solved.transport);
  EXPECT_EQ(factors(0, 1), 0);
  EXPECT_EQ(factors(1, 0), 0);
  EXPECT_NEAR(factors(0, 2), kOpposed, kKernel);
  EXPECT_EQ(factors(0, 3), 0);
  EXPECT_NEAR(factors(3, 1), kOpposed, kKernel);
  EXPECT_EQ(factors(3, 0), 0);
  // tests/data/form-factors.json: lateral offset (1, 0). The plane hides the squares' view of each
  // other but for what passes outside the tiles, where they face nothing.
  EXPECT_NEAR(factors(2, 1), 0.0860504891523273353, kKernel);
  expect_agreement_with_points(solved);
}

TEST(HardGeometry, NeedlesCloseARoom) {
  // The floor of a cube with a needle of aspect 1:1e5 along an edge.
  const std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},     {0, 0, 1},
                                      {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 1e-5, 0}};
  const Solved solved(triangles(vertices, {{0, 1, 8, -1},
                                           {0, 8, 3, -1},
                                           {8, 1, 2, -1},
                                           {3, 8, 2, -1},
                                           {4, 7, 6, 5},
                                           {0, 4, 5, 1},
                                           {3, 2, 6, 7},
                                           {0, 3, 7, 4},
                                           {1, 5, 6, 2}}));
  expect_sane(solved);
  expect_closed(solved);
  // From a needle the ceiling is seen as from its middle line.
  double expected = 0;
  for_each_quadrature_point(outline(solved.mesh, 0), 20, [&](const Vec3& point, double weight) {
    expected += weight * point_to_polygon(point, Vec3::UnitZ(), outline(solved.mesh, 4));
  });
  EXPECT_NEAR(solved.factors()(0, 4), expected / solved.mesh.area[0], kKernel);
}

TEST(HardGeometry, NeedlesAmongObstacles) {
  PatchMesh mesh = furnished_room(1, Vec3::Zero());
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(),
                       {Vec3(0.1, 0.2, 0.15), Vec3(0.9, 0.2, 0.2), Vec3(0.1, 0.2 + 1e-5, 0.15)});
  mesh.surface_names.emplace_back("needle");
  mesh.surface_two_sided.push_back(false);
  const auto surface = static_cast<std::int32_t>(mesh.surface_names.size()) - 1;
  mesh.add_patch({first, first + 1, first + 2, -1}, surface, surface);
  test::make_two_sided(mesh, surface);
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  expect_closed(solved);
}

/// Agreement, weighted by exchange, to a tenth of the tolerance that both were made with.
void expect_same_factors(const Solved& solved, const Solved& expected) {
  const Eigen::MatrixXd factors = expected.exchange() / expected.mesh.area[0];
  const Eigen::MatrixXd others = solved.exchange() / solved.mesh.area[0];
  EXPECT_LE((others - factors).cwiseAbs().sum(), 0.1 * kHardTolerance * factors.sum());
}

TEST(HardGeometry, PowersOfTwoScaleExactly) {
  const Solved metres(furnished_room(1, Vec3::Zero()));
  for (const double scale : {0x1p-20, 0x1p20}) {
    const Solved solved(furnished_room(scale, Vec3::Zero()));
    EXPECT_EQ(solved.factors(), metres.factors()) << scale;
    EXPECT_EQ(solved.exchange(), scale * scale * metres.exchange()) << scale;
  }
}

TEST(HardGeometry, MicrometresAndMegametres) {
  // Rounding decides ties, such as which of two equal patches is sampled: other samples, no more.
  const Solved metres(furnished_room(1, Vec3::Zero()));
  for (const double scale : {1e-6, 1e6}) {
    SCOPED_TRACE(scale);
    const Solved solved(furnished_room(scale, Vec3::Zero()));
    expect_sane(solved);
    expect_closed(solved);
    expect_same_factors(solved, metres);
  }
}

TEST(HardGeometry, FarFromTheOrigin) {
  const Solved there(furnished_room(1, Vec3(1e7, -1e7, 1e7)));
  expect_sane(there);
  expect_closed(there);
  // Coordinates are rounded by up to 2^-30 m there, 1e-8 of a patch: nothing beside the tolerance.
  expect_same_factors(there, Solved(furnished_room(1, Vec3::Zero())));
}

/// A point at height 1 above the middle of a square of 2 x 2 r sees this share of its hemisphere in
/// it: F = 4/π x/√(1+x²) atan(x/√(1+x²)) (Howell's catalogue, B-3, four times), where x = r.
double seen_from_above(double r) {
  const double share = r / std::sqrt(1 + r * r);
  return 4 / kPi * share * std::atan(share);
}

TEST(HardGeometry, TinyBesideHugeWithoutObstacles) {
  for (const double r : {1e2, 1e4, 1e6, 1e8}) {
    SCOPED_TRACE(r);
    const std::vector<Vec3> ground = {{-r, -r, 0}, {r, -r, 0}, {r, r, 0}, {-r, r, 0}};
    constexpr double kHalf = 5e-4;  // of the panel's side: nearly a point
    constexpr double kArea = 4 * kHalf * kHalf;
    const std::vector<Vec3> above = {
        {-kHalf, -kHalf, 1}, {-kHalf, kHalf, 1}, {kHalf, kHalf, 1}, {kHalf, -kHalf, 1}};
    EXPECT_NEAR(exchange_area(above, ground) / kArea, seen_from_above(r), kKernel);
    EXPECT_NEAR(exchange_area(ground, above) / kArea, seen_from_above(r), kKernel);
    // Upright on the ground it sees half of it but for what ends at r.
    const std::vector<Vec3> upright = {
        {-kHalf, 0, 0}, {-kHalf, 0, 2 * kHalf}, {kHalf, 0, 2 * kHalf}, {kHalf, 0, 0}};
    EXPECT_NEAR(exchange_area(upright, ground) / kArea, 0.5, kHalf / r + kKernel);
  }
}

TEST(HardGeometry, TinyObstacleAboveHugeGround) {
  // A panel at height 1, and half a metre below it a screen under one half of it. What the panel
  // sees of an endless ground is what the screen leaves.
  constexpr double kLeft = 0.792373;
  for (const double r : {1e4, 1e5, 1e6, 1e7}) {
    for (const int n : {1, 2, 3, 10}) {
      SCOPED_TRACE(std::to_string(r) + ", divided by " + std::to_string(n));
      PatchMesh mesh;
      add_grid(mesh, Vec3(-0.5, -0.5, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
      test::make_two_sided(
          mesh, add_grid(mesh, Vec3(-0.5, -0.5, 0.5), Vec3(0.5, 0, 0), Vec3(0, 1, 0), 1, 1));
      add_grid(mesh, Vec3(-r, -r, 0), Vec3(2 * r, 0, 0), Vec3(0, 2 * r, 0), n, n);
      const Solved solved(std::move(mesh));
      expect_sane(solved);
      EXPECT_NEAR(surface_form_factors(solved.mesh, *solved.transport)(0, 2), kLeft,
                  kHardTolerance);
    }
  }
}

TEST(HardGeometry, SurfacesThatShareAPartOfAnEdge) {
  // A wall on the middle third of a floor's edge; and on the same floor in three pieces.
  PatchMesh whole;
  add_grid(whole, Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), 1, 1);
  PatchMesh pieces = whole;
  add_grid(whole, Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 1, 0), 1, 1);
  add_grid(pieces, Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 1, 0), 3, 1);
  const Solved solved(std::move(whole));
  expect_sane(solved);
  const Eigen::VectorXd of_pieces = Solved(std::move(pieces)).factors().row(0);
  // tests/data/form-factors.json: perpendicular unit squares, common edge.
  EXPECT_NEAR(of_pieces[2], 0.200043776075403154, kKernel);
  EXPECT_NEAR(of_pieces[1], of_pieces[3], kKernel);
  EXPECT_NEAR(solved.factors()(0, 1), of_pieces.sum(), kKernel);
}

TEST(HardGeometry, ShelfOnAPartOfAWall) {
  // Both sides of the shelf touch the wall along a line in the midst of it.
  PatchMesh mesh = room(1);
  test::make_two_sided(mesh,
                       add_grid(mesh, Vec3(0, 0.2, 0.45), Vec3(0.3, 0, 0), Vec3(0, 0.5, 0), 1, 1));
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  expect_closed(solved);
  expect_agreement_with_points(solved);
}

TEST(HardGeometry, DuplicatesCountTwice) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  for (const Index ceiling : {1, 2}) {
    EXPECT_NEAR(solved.factors()(0, ceiling), kOpposed, kKernel);
    EXPECT_NEAR(solved.factors()(ceiling, 0), kOpposed, kKernel);
  }
  EXPECT_EQ(solved.factors()(1, 2), 0);
}

TEST(HardGeometry, PlateOfTwoOneSidedSurfaces) {
  // A common way to model a thin plate: the same polygon twice, back to back.
  PatchMesh mesh = room(1);
  add_grid(mesh, Vec3(0.3, 0.3, 0.5), Vec3(0.4, 0, 0), Vec3(0, 0.4, 0), 1, 1);
  add_grid(mesh, Vec3(0.3, 0.3, 0.5), Vec3(0, 0.4, 0), Vec3(0.4, 0, 0), 1, 1);
  PatchMesh two_sided = room(1);
  test::make_two_sided(
      two_sided, add_grid(two_sided, Vec3(0.3, 0.3, 0.5), Vec3(0.4, 0, 0), Vec3(0, 0.4, 0), 1, 1));
  const Solved solved(std::move(mesh));
  expect_sane(solved);
  expect_closed(solved);
  const Solved expected(std::move(two_sided));
  const Eigen::MatrixXd variance = solved.errors().cwiseAbs2() + expected.errors().cwiseAbs2();
  const Eigen::MatrixXd difference = solved.factors() - expected.factors();
  EXPECT_LE((difference.cwiseAbs() - kSigmas * variance.cwiseSqrt()).maxCoeff(), kKernel);
}

TEST(HardGeometry, InspectCallsDuplicatesSerious) {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  scene.materials.resize(1);
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const char* name : {"one", "same"}) {
    scene.surfaces.push_back({.name = name, .material = 0, .two_sided = false});
    scene.add_polygon(std::vector<std::int32_t>{0, 1, 2, 3},
                      static_cast<std::int32_t>(scene.surfaces.size()) - 1);
  }
  const std::vector<meshing::Finding> findings = meshing::inspect(scene).findings;
  const auto duplicate = std::find_if(findings.begin(), findings.end(), [](const auto& finding) {
    return finding.kind == meshing::Finding::Kind::duplicate_polygon;
  });
  ASSERT_NE(duplicate, findings.end());
  EXPECT_EQ(duplicate->severity, meshing::Finding::Severity::serious);
  // They are not taken out: the scene's author decides which one stays.
  EXPECT_EQ(meshing::make_patches(scene).size(), 2);
}

}  // namespace
}  // namespace radiosity
