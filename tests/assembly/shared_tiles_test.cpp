// Operators that several ranks make and keep together against those of one: the same bits. Ranks
// are threads here.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <set>
#include <string>

#include "radiosity/assembly/dense_transport.h"
#include "radiosity/assembly/exchange_assembly.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/tile_shares.h"
#include "radiosity/base/error.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"
#include "tests/support/thread_ranks.h"

namespace radiosity {
namespace {

using test::add_box;
using test::Facing;
using test::on_ranks;

constexpr double kTolerance = 3e-2;

/// A box in a room, turned and moved; without a ceiling it is open.
PatchMesh room(int n, bool is_open, double angle) {
  PatchMesh mesh;
  add_box(mesh, Vec3(0.35, 0.3, 0.25), Vec3(0.65, 0.6, 0.75), n, Facing::outwards);
  if (is_open) {
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 2 * n, n);
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), 2 * n, 2 * n);
  } else {
    add_box(mesh, Vec3::Zero(), Vec3::Ones(), n, Facing::inwards);
  }
  const Eigen::AngleAxisd turn(angle, Vec3(1, 2, -1).normalized());
  PatchMesh turned = mesh;
  for (Vec3& vertex : turned.vertices) vertex = turn * vertex + angle * Vec3(10, -20, 5);
  for (Vec3& centroid : turned.centroid) centroid = turn * centroid + angle * Vec3(10, -20, 5);
  for (Vec3& normal : turned.normal) normal = turn * normal;
  return turned;
}

/// All that is found out of a mesh.
struct Found {
  AssemblyReport report;
  Eigen::MatrixXd applied, apply_error;
  Eigen::VectorXd row, row_error;
  ExchangeArea pair;
  double error = 0;
  Solution solution;
  Eigen::MatrixXd size_error;
  std::size_t bytes = 0;
};

Found find(const PatchMesh& mesh, Ranks* ranks) {
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = kTolerance, .ranks = ranks});
  const Index n = mesh.size();
  Eigen::MatrixXd fields(n, 10);
  for (Index i = 0; i < n; ++i) {
    for (Index c = 0; c < 10; ++c) fields(i, c) = 1 + std::sin(static_cast<double>(i * (c + 1)));
  }
  Found found;
  found.report = transport->report();
  found.applied = transport->apply(fields);
  found.apply_error = transport->apply_error(fields.leftCols(2));
  found.row = rows_of(*transport).row(n / 3);
  found.row_error = rows_of(*transport).row_error(n / 3);
  found.pair = rows_of(*transport).pair(n / 3, n - 1);
  found.error = transport->error();
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(n, 2);
  exitance.topRows(n / 8).setConstant(3);
  const Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(n, 1, 0.7);
  found.solution = solve(*transport, exitance, reflectance, {.tolerance = 1e-6});
  found.size_error = discretisation_error(mesh, *transport, found.solution).error;
  found.bytes = transport->bytes();
  return found;
}

void expect_same(const Found& one, const Found& other) {
  EXPECT_EQ(one.report.rays, other.report.rays);
  EXPECT_EQ(one.report.facing, other.report.facing);
  EXPECT_EQ(one.report.closed, other.report.closed);
  EXPECT_EQ(one.report.row_sums, other.report.row_sums);
  EXPECT_EQ(one.applied, other.applied);
  EXPECT_EQ(one.apply_error, other.apply_error);
  EXPECT_EQ(one.row, other.row);
  EXPECT_EQ(one.row_error, other.row_error);
  EXPECT_EQ(one.pair.value, other.pair.value);
  EXPECT_EQ(one.pair.error, other.pair.error);
  EXPECT_EQ(one.pair.is_certain, other.pair.is_certain);
  EXPECT_EQ(one.error, other.error);
  EXPECT_EQ(one.solution.radiosity, other.solution.radiosity);
  EXPECT_EQ(one.solution.radiosity_error, other.solution.radiosity_error);
  EXPECT_EQ(one.solution.error_bound, other.solution.error_bound);
  EXPECT_EQ(one.size_error, other.size_error);
}

void expect_same_on(int n_ranks, const PatchMesh& mesh) {
  SCOPED_TRACE(std::to_string(n_ranks) + " ranks, " + std::to_string(mesh.size()) + " patches");
  const Found alone = find(mesh, nullptr);
  std::vector<Found> found(n_ranks);
  on_ranks(n_ranks, [&](Ranks& ranks) { found[ranks.rank()] = find(mesh, &ranks); });
  std::size_t most = 0;
  std::size_t sum = 0;
  for (const Found& one : found) {
    expect_same(alone, one);
    most = std::max(most, one.bytes);
    sum += one.bytes;
  }
  // Each has its parts of the sums, of which one more or less, and its own diagonal.
  const auto n = static_cast<double>(mesh.size());
  EXPECT_LE(static_cast<double>(sum), static_cast<double>(alone.bytes) + 8 * n * n_ranks);
  if (SumParts(Strips({0, mesh.size()})).n_parts >= n_ranks) {
    EXPECT_LT(most, alone.bytes);
  }
}

TEST(SharedTiles, GiveTheSameBitsInAClosedRoom) { expect_same_on(2, room(8, false, 0.7)); }

TEST(SharedTiles, GiveTheSameBitsOfFewPatches) { expect_same_on(3, room(4, false, 0)); }

TEST(SharedTiles, GiveTheSameBitsWithMoreRanksThanPartsOfSums) {
  expect_same_on(5, room(9, true, 1.9));
}

TEST(TileShares, HaveEachTileOnce) {
  for (const Index n_strips : {1, 2, 3, 40, 77}) {
    std::vector<Index> boundaries{0};
    for (Index k = 0; k < n_strips; ++k) boundaries.push_back(boundaries.back() + 20 + k % 40);
    const Strips strips(boundaries);
    const SumParts parts(strips);
    for (const int n_ranks : {1, 2, 3, 5, 64, 100}) {
      const TileShares shares(strips, n_ranks);
      std::vector<Index> made(n_ranks, 0);
      for (Index column = 0; column < n_strips; ++column) {
        for (Index row = 0; row <= column; ++row) {
          const int maker = shares.maker(row, column);
          ASSERT_GE(maker, 0);
          ASSERT_LT(maker, n_ranks);
          ++made[maker];
          const Index tile = Strips::tile(row, column);
          const Index part = parts.of_tile(tile);
          ASSERT_LE(parts.begin(part), tile);
          ASSERT_LT(tile, parts.begin(part + 1));
          const auto [first, last] = parts.share(shares.keeper(row, column), n_ranks);
          ASSERT_LE(first, part);
          ASSERT_LT(part, last);
        }
      }
      if (n_strips < 16 * n_ranks) continue;
      const auto [least, most] = std::minmax_element(made.begin(), made.end());
      // A rank may have a turn more, of which there are 16 for each at least; a strip has its tile
      // with itself and half of the others.
      const Index turn = n_strips / (16 * n_ranks);
      EXPECT_LE(*most - *least, turn * (n_strips / 2 + 1) + n_strips / 2);
    }
  }
}

TEST(Ranks, TellTheOthersThatTheFirstHasFailed) {
  std::atomic<int> n_failed = 0;
  on_ranks(3, [&](Ranks& ranks) {
    try {
      on_first_rank(&ranks, [] { throw OutputError("no"); });
    } catch (const FirstRankFailed&) {
      ++n_failed;
    } catch (const OutputError&) {
      EXPECT_EQ(ranks.rank(), 0);
    }
  });
  EXPECT_EQ(n_failed, 2);
}

TEST(Ranks, SumTheirValues) {
  on_ranks(4, [&](Ranks& ranks) {
    std::array<std::int64_t, 2> values = {ranks.rank() + 1, std::int64_t{1} << 60};
    sum_over_ranks(ranks, std::span<std::int64_t>(values));
    EXPECT_EQ(values[0], 10);
    EXPECT_EQ(values[1], std::int64_t{1} << 62);
    EXPECT_EQ(least_of_ranks(ranks, 7 - ranks.rank()), 4);
  });
}

}  // namespace
}  // namespace radiosity
