#include "radiosity/operator/transport.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stop_token>

#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/base/parallel.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::box_in_box;
using test::Facing;

/// Form factor between surfaces, area-weighted, with its standard error.
struct SurfaceFactor {
  double value = 0;
  double error = 0;
};

SurfaceFactor surface_factor(const PatchMesh& mesh, const Transport& transport, std::int32_t from,
                             std::int32_t to) {
  SurfaceFactor result;
  double area = 0;
  double variance = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] != from) continue;
    area += mesh.area[i];
    const Eigen::VectorXd row = rows_of(transport).row(i);
    const Eigen::VectorXd error = rows_of(transport).row_error(i);
    for (Index j = 0; j < mesh.size(); ++j) {
      if (mesh.surface[j] != to) continue;
      result.value += mesh.area[i] * row[j];
      variance += std::pow(mesh.area[i] * error[j], 2);
    }
  }
  result.value /= area;
  result.error = std::sqrt(variance) / area;
  return result;
}

TEST(Transport, CubeFacesAreExact) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 1, Facing::inwards);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  // tests/data/form-factors.json: cube interior.
  const Eigen::VectorXd row = rows_of(*transport).row(0);
  EXPECT_EQ(row[0], 0);
  EXPECT_NEAR(row[1], 0.199824895698387383, 1e-12);
  for (int j = 2; j < 6; ++j) EXPECT_NEAR(row[j], 0.200043776075403154, 1e-12);
  EXPECT_EQ(transport->report().undecided, 0);
  EXPECT_TRUE(transport->report().closed);
  EXPECT_EQ(transport->error(), 0);
}

TEST(Transport, ConvexRoomNeedsNoRaysAndCloses) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3(1, 2, 0.7), 8, Facing::inwards);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  EXPECT_EQ(transport->report().rays, 0);
  EXPECT_LT(transport->report().closure_max, 1e-8);
}

TEST(Transport, ReciprocityIsExact) {
  const PatchMesh mesh = box_in_box(3, 3);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  Eigen::MatrixXd exchange(mesh.size(), mesh.size());
  Eigen::MatrixXd factors(mesh.size(), mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    factors.row(i) = rows_of(*transport).row(i);
    exchange.row(i) = factors.row(i) * mesh.area[i];
  }
  // F is G divided by the area, which costs one rounding.
  EXPECT_LE((exchange - exchange.transpose()).cwiseAbs().maxCoeff(),
            2 * std::numeric_limits<double>::epsilon() * exchange.maxCoeff());
  EXPECT_GE(factors.minCoeff(), 0);
  EXPECT_LE(factors.maxCoeff(), 1);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(mesh.size(), 11);
  EXPECT_LT((transport->apply(b) - factors * b).cwiseAbs().maxCoeff(), 1e-14);
}

/// tests/data/form-factors.json: squares at distance 1, a square screen half way.
TEST(Transport, SquareScreenBetweenSquares) {
  struct Case {
    double side, x, y, expected;
  };
  for (const Case& c :
       {Case{0.25, 0, 0, 0.169474204911786234}, Case{0.5, 0, 0, 0.0995062945989847863},
        Case{0.5, 0.25, 0.25, 0.149868671773790537}}) {
    for (const int n : {1, 6}) {
      PatchMesh mesh;
      const auto low = add_grid(mesh, Vec3(-0.5, -0.5, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), n, n);
      const auto high = add_grid(mesh, Vec3(-0.5, -0.5, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), n, n);
      const auto screen = add_grid(mesh, Vec3(c.x - c.side / 2, c.y - c.side / 2, 0.5),
                                   Vec3(c.side, 0, 0), Vec3(0, c.side, 0), n, n);
      test::make_two_sided(mesh, screen);
      const Visibility visibility(mesh);
      for (const double tolerance : {1e-3, 1e-7}) {
        const auto transport = make_dense_transport(mesh, visibility, {.tolerance = tolerance});
        const SurfaceFactor factor = surface_factor(mesh, *transport, low, high);
        EXPECT_NEAR(factor.value, c.expected, tolerance * c.expected) << c.side << " " << n;
        EXPECT_GT(factor.error, 0);
        EXPECT_LE(factor.error, tolerance * c.expected);  // it is known to be as good as asked
        EXPECT_EQ(transport->report().rays, 0);
      }
    }
  }
}

TEST(Transport, SeptumHidesExactly) {
  // Each half sees the opposite half on its own side only; pairs across are proved hidden.
  PatchMesh mesh;
  const auto low = add_grid(mesh, Vec3(-0.5, -0.5, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 6, 6);
  const auto high = add_grid(mesh, Vec3(-0.5, -0.5, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 6, 6);
  const auto septum = add_grid(mesh, Vec3(0, -5, -5), Vec3(0, 10, 0), Vec3(0, 0, 10), 1, 1);
  test::make_two_sided(mesh, septum);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  const SurfaceFactor factor = surface_factor(mesh, *transport, low, high);
  EXPECT_NEAR(factor.value, 0.116653691803622898, 1e-8);
  EXPECT_EQ(factor.error, 0);
  EXPECT_GT(transport->report().hidden, 0);
}

TEST(Transport, CubeInCube) {
  // tests/data/form-factors.json: cube of side 0.5 centred in the unit cube.
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 4, Facing::inwards);
  add_box(mesh, Vec3::Constant(0.25), Vec3::Constant(0.75), 3, Facing::outwards);
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no});
  double inner_to_outer = 0;
  double outer_to_inner = 0;
  double variance = 0;
  for (std::int32_t a = 0; a < 6; ++a) {
    for (std::int32_t b = 6; b < 12; ++b) {
      inner_to_outer += surface_factor(mesh, *transport, b, a).value / 6;
      const SurfaceFactor factor = surface_factor(mesh, *transport, a, b);
      outer_to_inner += factor.value / 6;
      variance += std::pow(factor.error / 6, 2);
    }
  }
  EXPECT_NEAR(outer_to_inner, 0.25, 4 * std::sqrt(variance) + 1e-8);
  EXPECT_NEAR(inner_to_outer, 1, 16 * std::sqrt(variance) + 4e-8);
  EXPECT_NEAR(surface_factor(mesh, *transport, 6, 0).value, 0.794452723252117493, 1e-8);
}

/// The unit cube as 6 n² patches with entries in double, then in single precision: the rounding of
/// single precision is all that differs.
TEST(Transport, SinglePrecisionRoundsEntriesOnly) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 10, Facing::inwards);  // 600 patches
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  const Eigen::VectorXd row = rows_of(*transport).row(0);
  for (Index j = 1; j < mesh.size(); ++j) {
    std::vector<Vec3> a;
    std::vector<Vec3> b;
    for (int k = 0; k < 4; ++k) {
      a.push_back(mesh.corner(0, k));
      b.push_back(mesh.corner(j, k));
    }
    EXPECT_NEAR(row[j], exchange_area(a, b) / mesh.area[0], 1e-7 * row[j] + 1e-18);
  }
}

TEST(Transport, ClosureCorrectionClosesWithoutBreakingReciprocity) {
  const PatchMesh mesh = box_in_box(5, 5);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility, {.closed = Closed::yes});
  const auto raw = make_dense_transport(mesh, visibility, {.closed = Closed::no});
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.size());
  EXPECT_LT((transport->apply(ones).array() - 1).abs().maxCoeff(), 1e-10);
  EXPECT_GT((raw->apply(ones).array() - 1).abs().maxCoeff(), 1e-8);
  EXPECT_TRUE(make_dense_transport(mesh, visibility)->report().closed);
  // Only uncertain entries move, and by no more than a few of their standard errors.
  for (Index i = 0; i < mesh.size(); i += 17) {
    const Eigen::VectorXd change = rows_of(*transport).row(i) - rows_of(*raw).row(i);
    const Eigen::VectorXd error = rows_of(*raw).row_error(i);
    for (Index j = 0; j < mesh.size(); ++j) EXPECT_LE(std::abs(change[j]), 6 * error[j]);
  }
}

TEST(Transport, OpenSceneIsNotTakenAsClosed) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 4, 4);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 4, 4);
  const Visibility visibility(mesh);
  EXPECT_FALSE(make_dense_transport(mesh, visibility)->report().closed);
  const auto forced = make_dense_transport(mesh, visibility, {.closed = Closed::yes});
  EXPECT_EQ(forced->report().open_rows, mesh.size());
  ASSERT_EQ(forced->report().open_patches.size(), static_cast<std::size_t>(mesh.size()));
  for (std::int32_t i = 0; i < mesh.size(); ++i) EXPECT_EQ(forced->report().open_patches[i], i);
}

TEST(Transport, SameBitsAtAnyNumberOfThreads) {
  const PatchMesh mesh = box_in_box(6, 6);
  const Visibility visibility(mesh);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(mesh.size(), 3);
  Eigen::MatrixXd single;
  {
    const ThreadLimit limit(1);
    single = make_dense_transport(mesh, visibility)->apply(b);
  }
  for (const std::size_t n_threads : {2U, 5U}) {
    const ThreadLimit limit(n_threads);
    EXPECT_EQ(make_dense_transport(mesh, visibility)->apply(b), single);
  }
}

TEST(Transport, CertificatesAgreeWithRays) {
  // Every pair that is proved hidden or visible is checked by rays.
  const PatchMesh mesh = box_in_box(6, 6);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility, {.closed = Closed::no});
  int n_checked = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd row = rows_of(*transport).row(i);
    const Eigen::VectorXd error = rows_of(*transport).row_error(i);
    for (Index j = i + 1; j < mesh.size(); ++j) {
      if (error[j] > 0) continue;
      std::vector<Vec3> from;
      std::vector<Vec3> to;
      for (int k = 0; k < 4; ++k) {
        from.push_back(mesh.centroid[i] + 0.98 * (mesh.corner(i, k) - mesh.centroid[i]));
        to.push_back(mesh.centroid[j] + 0.98 * (mesh.corner(j, (k + 1) % 4) - mesh.centroid[j]));
        const Vec3 way = to.back() - from.back();
        if (way.dot(mesh.normal[i]) <= 1e-9 || way.dot(mesh.normal[j]) >= -1e-9) {
          from.pop_back();
          to.pop_back();
        }
      }
      if (from.empty()) continue;
      const std::uint32_t blocked =
          visibility.blocked(from, to, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
      const std::uint32_t all = (1U << from.size()) - 1;
      EXPECT_EQ(blocked, row[j] > 0 ? 0U : all) << i << " " << j;
      ++n_checked;
    }
  }
  EXPECT_GT(n_checked, 10000);
}

TEST(Transport, SinglePrecisionStorageKeepsRowSums) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 15, Facing::inwards);  // 1350 patches
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.size());
  EXPECT_LT((transport->apply(ones).array() - 1).abs().maxCoeff(), 1e-10);
  const double n = static_cast<double>(mesh.size());
  EXPECT_LE(static_cast<double>(transport->bytes()), 2.4 * n * n);
  EXPECT_LE(static_cast<double>(transport->bytes()),
            static_cast<double>(dense_transport_bytes(mesh.size())));
}

TEST(SurfaceFactors, FlatAndConvexSurfacesSeeNothingOfThemselves) {
  PatchMesh mesh = box_in_box(10, 2);  // more patches than are kept in double precision
  const std::int32_t first_of_box = 6;
  for (std::int32_t& surface : mesh.surface) surface = std::min(surface, first_of_box);
  const Visibility visibility(mesh);
  const auto transport = make_dense_transport(mesh, visibility);
  const Eigen::MatrixXd factors = surface_form_factors(mesh, *transport);
  for (Index s = 0; s <= first_of_box; ++s) EXPECT_EQ(factors(s, s), 0) << s;
  // The walls together see each other.
  for (std::int32_t& surface : mesh.surface) surface = surface < first_of_box ? 0 : first_of_box;
  EXPECT_GT(surface_form_factors(mesh, *transport)(0, 0), 0.5);
}

TEST(Transport, StopsWhenAskedTo) {
  const PatchMesh mesh = box_in_box(4, 4);
  const Visibility visibility(mesh);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(make_dense_transport(mesh, visibility, {.progress = {{}, source.get_token()}}),
               Interrupted);
}

TEST(Transport, RefusesWhatDoesNotFit) {
  const PatchMesh mesh = box_in_box(4, 4);
  const Visibility visibility(mesh);
  try {
    make_dense_transport(mesh, visibility, {.memory = 1000});
    FAIL();
  } catch (const SolveError& error) {
    EXPECT_NE(std::string(error.what()).find("192 patches"), std::string::npos) << error.what();
  }
}

TEST(Transport, RefusesWhatTheMachineDoesNotHold) {
  if (usable_memory() == 0) GTEST_SKIP() << "this machine does not tell what it has";
  const PatchMesh small = box_in_box(4, 4);
  const Visibility visibility(small);
  PatchMesh mesh = small;
  mesh.corners.resize(2'000'000);  // 10 TB, of which nothing may be touched
  EXPECT_THROW(make_dense_transport(mesh, visibility), SolveError);
}

std::string refusal(Index n_patches, Index n_polygons, std::size_t memory) {
  try {
    check_memory(n_patches, n_polygons, memory);
    return "";
  } catch (const SolveError& error) {
    return error.what();
  }
}

TEST(DenseMemory, TellsTheWayOut) {
  const std::size_t memory = dense_transport_bytes(5000);
  EXPECT_EQ(refusal(5000, 100, memory), "");
  EXPECT_NE(refusal(5001, 100, memory).find("use --patches 5000"), std::string::npos);
  EXPECT_NE(refusal(20'000, 0, memory).find("use --patches 5000"), std::string::npos);
  EXPECT_NE(refusal(20'000, 6000, memory).find("fewer polygons"), std::string::npos);
}

TEST(DenseMemory, LargestProblemIsTheLargestThatFits) {
  for (const Index n : {10, 99, 120, 5000, 36'000}) {
    EXPECT_EQ(largest_problem(dense_transport_bytes(n)), n);
    EXPECT_LT(largest_problem(dense_transport_bytes(n) - 1), n);
  }
  EXPECT_EQ(largest_problem(1), 0);
}

TEST(Transport, EmptyMesh) {
  const PatchMesh mesh;
  const Visibility visibility(mesh);
  EXPECT_EQ(make_dense_transport(mesh, visibility)->size(), 0);
}

/// A turned box whose corners were rounded to a micrometre: its faces are not quite planar, and
/// must not lie in their own shadow.
TEST(Transport, FacesThatAreOnlyPlanarToTheDigitsOfAFileShadowNothingOfTheirOwn) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 2, Facing::inwards);
  const auto first = static_cast<Index>(mesh.vertices.size());
  add_box(mesh, Vec3(-0.2, -0.15, -0.25), Vec3(0.2, 0.15, 0.25), 1, Facing::outwards);
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  PatchMesh rounded;
  rounded.vertices = mesh.vertices;
  rounded.surface_names = mesh.surface_names;
  rounded.surface_two_sided = mesh.surface_two_sided;
  for (auto v = first; v < static_cast<Index>(rounded.vertices.size()); ++v) {
    const Vec3 turned = turn * mesh.vertices[v] + Vec3(0.5, 0.5, 0.5);
    rounded.vertices[v] = (turned * 1e6).array().round() / 1e6;
  }
  for (Index i = 0; i < mesh.size(); ++i) {
    rounded.add_patch(mesh.corners[i], mesh.surface[i], mesh.polygon[i]);
  }
  const Visibility visibility(rounded);
  const auto transport =
      make_dense_transport(rounded, visibility, {.tolerance = 1e-4, .closed = Closed::no});
  EXPECT_LE(transport->report().closure_max, 1e-4);
}

}  // namespace
}  // namespace radiosity
