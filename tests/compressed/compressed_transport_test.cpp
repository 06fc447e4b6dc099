#include "radiosity/compressed/compressed_transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stop_token>
#include <utility>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/closed_blocks.h"
#include "radiosity/compressed/light_polygons.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/exchange/exchange_evaluator.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/uneven_light.h"
#include "radiosity/visibility/coverage.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::box_in_box;
using test::Facing;

/// ‖x - y‖ / ‖y‖ with the areas as weights.
double difference(const Transport& transport, const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
  const auto norm = [&](const Eigen::MatrixXd& z) {
    return std::sqrt(transport.area().dot(z.cwiseAbs2().rowwise().sum()));
  };
  return norm(x - y) / norm(y);
}

struct Room {
  explicit Room(PatchMesh patches) : mesh(std::move(patches)), visibility(mesh) {}
  PatchMesh mesh;
  Visibility visibility;
};

class CompressedTransportOfARoom : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room_ = new Room(box_in_box(12, 6));
    compressed_ =
        make_compressed_transport(room_->mesh, room_->visibility, {.tolerance = 1e-2}).release();
  }
  static void TearDownTestSuite() {
    delete compressed_;
    delete room_;
  }
  inline static Room* room_ = nullptr;
  inline static CompressedTransport* compressed_ = nullptr;
};

TEST_F(CompressedTransportOfARoom, ActsLikeTheDenseOneWithinItsVerifiedError) {
  const auto dense = make_dense_transport(room_->mesh, room_->visibility, {.tolerance = 1e-3});
  const Index n = dense->size();
  Eigen::MatrixXd b(n, 2);
  b.col(0).setOnes();
  for (Index i = 0; i < n; ++i) b(i, 1) = 1 + room_->mesh.centroid[i].x();
  ASSERT_TRUE(compressed_->report().compression);
  const double verified = compressed_->report().compression->verified_error;
  EXPECT_LE(verified, 1e-2);
  for (Index c = 0; c < 2; ++c) {
    EXPECT_LE(difference(*dense, compressed_->apply(b.col(c)), dense->apply(b.col(c))),
              verified + 1e-3);
  }
  EXPECT_LT(compressed_->bytes(), dense->bytes());
}

TEST_F(CompressedTransportOfARoom, IsReciprocalToTheLastBit) {
  const Index n = compressed_->size();
  for (Index i = 0; i < n; i += 37) {
    for (Index j = 0; j < n; j += 41) {
      EXPECT_EQ(compressed_->pair(i, j).value, compressed_->pair(j, i).value);
    }
  }
}

TEST_F(CompressedTransportOfARoom, HasRowsThatMakeUpItsAction) {
  const Index n = compressed_->size();
  Eigen::VectorXd b(n);
  for (Index i = 0; i < n; ++i) b[i] = 1 + std::sin(static_cast<double>(i));
  const Eigen::VectorXd gathered = compressed_->apply(b);
  for (Index i = 5; i < n; i += 397) {
    const Eigen::VectorXd row = compressed_->row(i);
    EXPECT_NEAR(row.dot(b), gathered[i], 1e-9);
    for (Index j = 0; j < n; j += 53) {
      EXPECT_NEAR(row[j], compressed_->pair(i, j).value / compressed_->area()[i], 1e-9);
    }
  }
}

TEST_F(CompressedTransportOfARoom, ClosesItsRows) {
  const Eigen::VectorXd sums = compressed_->apply(Eigen::VectorXd::Ones(compressed_->size()));
  EXPECT_TRUE(compressed_->report().closed);
  EXPECT_EQ(compressed_->report().open_rows, 0);
  // A row that nothing uncertain adds to keeps its sum: fits are as good as the tolerance.
  EXPECT_LT((sums.array() - 1).abs().mean(), 1e-4);
}

/// However many columns go through blocks at once, of a closed room with what closes it.
TEST_F(CompressedTransportOfARoom, ActsOnColumnsTogetherAsOnEach) {
  const Index n = compressed_->size();
  ASSERT_GT(compressed_->parts().multipliers.size(), 0);
  Eigen::MatrixXd x(n, 13);
  for (Index c = 0; c < x.cols(); ++c) {
    for (Index i = 0; i < n; ++i) x(i, c) = std::sin(static_cast<double>(i * (c + 1)));
  }
  Eigen::MatrixXd one_by_one(n, x.cols());
  for (Index c = 0; c < x.cols(); ++c) one_by_one.col(c) = compressed_->apply(x.col(c));
  for (Index n_columns = 0; n_columns <= x.cols(); ++n_columns) {
    const Eigen::MatrixXd together = compressed_->apply(x.leftCols(n_columns));
    ASSERT_EQ(together.cols(), n_columns);
    EXPECT_TRUE(together.isApprox(one_by_one.leftCols(n_columns), 1e-13)) << n_columns;
  }
}

TEST_F(CompressedTransportOfARoom, KeepsTheEnergyOfAFurnace) {
  // ρ = ½ and M_e = 1 everywhere: B = 2 but for the rows' errors.
  const Index n = compressed_->size();
  const Solution solution = solve(*compressed_, Eigen::MatrixXd::Ones(n, 1),
                                  Eigen::MatrixXd::Constant(n, 1, 0.5), {.tolerance = 1e-8});
  EXPECT_LT(difference(*compressed_, solution.radiosity, Eigen::MatrixXd::Constant(n, 1, 2)),
            compressed_->report().compression->verified_error);
}

TEST_F(CompressedTransportOfARoom, TellsWhatUnevenLightMakesOfIt) {
  // As the dense one does, with all rows: where patches are close, blocks are entries.
  const auto dense = make_dense_transport(room_->mesh, room_->visibility, {.tolerance = 1e-3});
  const Index n = dense->size();
  Eigen::MatrixXd emitted = Eigen::MatrixXd::Zero(n, 2);
  emitted.topRows(n / 3).col(0).setOnes();
  emitted.bottomRows(n / 3).col(1).setOnes();
  const Solution solution = solve(*dense, emitted, Eigen::MatrixXd::Constant(n, 1, 0.6));
  const NeighborGroups groups = make_neighbor_groups(room_->mesh);
  const Eigen::MatrixXd expected = uneven_light_error(room_->mesh, *dense, solution, groups);
  const Eigen::MatrixXd error = uneven_light_error(room_->mesh, *compressed_, solution, groups);
  ASSERT_EQ(error.cols(), 2);
  ASSERT_GT(expected.minCoeff(), 0);
  EXPECT_LT(difference(*dense, error, expected), 0.1);
}

TEST_F(CompressedTransportOfARoom, RefusesMethodsThatGoRowByRow) {
  const Index n = compressed_->size();
  for (const Method method : {Method::gauss_seidel, Method::southwell}) {
    EXPECT_THROW(solve(*compressed_, Eigen::MatrixXd::Ones(n, 1),
                       Eigen::MatrixXd::Constant(n, 1, 0.5), {.method = method}),
                 SolveError);
  }
}

TEST_F(CompressedTransportOfARoom, IsTheSameWithAnyNumberOfThreads) {
  const Eigen::MatrixXd b = Eigen::VectorXd::LinSpaced(compressed_->size(), 0, 1).replicate(1, 5);
  const Eigen::MatrixXd expected = compressed_->apply(b);
  for (const std::size_t n_threads : {1U, 3U, 7U}) {
    const ThreadLimit limit(n_threads);
    const auto again =
        make_compressed_transport(room_->mesh, room_->visibility, {.tolerance = 1e-2});
    EXPECT_EQ(again->apply(b), expected) << n_threads;
    EXPECT_EQ(again->error(), compressed_->error());
  }
}

TEST(CompressedTransport, GivesDirectLightOfAPolygonAsIs) {
  // Exact where the operator by itself may be off by its tolerance, which is loose here.
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const Room room(meshing::make_patches(scene, {.n_patches = 1500}));
  const Eigen::MatrixXd emitted = exitance(scene, room.mesh);
  const auto dense = make_dense_transport(room.mesh, room.visibility, {.tolerance = 1e-3});
  const auto with = make_compressed_transport(room.mesh, room.visibility, {.tolerance = 5e-2},
                                              {emitted, reflectance(scene, room.mesh)});
  const auto without = make_compressed_transport(room.mesh, room.visibility, {.tolerance = 5e-2});
  const Eigen::MatrixXd expected = dense->apply(emitted);
  // A patch's direct light is off by a tenth of the tolerance at most, where it is hidden in part.
  const double off = difference(*dense, with->apply(emitted), expected);
  EXPECT_LT(off, 0.1 * 5e-2);
  EXPECT_GT(difference(*dense, without->apply(emitted), expected), 3 * off);
}

TEST(CompressedTransport, KeepsDirectLightWhereItClosesRows) {
  // What closing adds to a row went to its lamps, too: a sixth of their light in this room.
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/furnished-room.json");
  const Room room(meshing::make_patches(scene, {.n_patches = 1200}));
  const Eigen::MatrixXd emitted = exitance(scene, room.mesh);
  const TransportOptions options{.tolerance = 5e-2, .closed = Closed::yes};
  const auto compressed = make_compressed_transport(room.mesh, room.visibility, options,
                                                    {emitted, reflectance(scene, room.mesh)});
  const Coverage coverage = find_coverage(room.mesh, plane_thickness(room.mesh));
  const ExchangeEvaluator evaluator(room.mesh, room.visibility, coverage, {.tolerance = 1e-3});
  const auto lights = make_light_polygons(
      evaluator, room.mesh, emitting_polygons(room.mesh, emitted), {.tolerance = 1e-2});
  ASSERT_EQ(lights.size(), 26U);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(room.mesh.size());
  for (const LightPolygon& light : lights) {
    expected += emitted(light.patches[0], 0) * light.exchange.cwiseQuotient(compressed->area());
  }
  EXPECT_LT(difference(*compressed, compressed->apply(emitted.col(0)), expected), 0.1 * 5e-2);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(room.mesh.size());
  const Eigen::ArrayXd seen = 1 - compressed->report().covered.array();
  EXPECT_LT((compressed->apply(ones).array() - seen).abs().mean(), 1e-3);
}

// A patch that others of its cluster do not resemble, as behind a box just off a wall, is off in
// all blocks of its row alike: by much more than the errors of the blocks tell. Rays find no
// opening there, and what lacks behind a screen they find.
TEST(CompressedTransport, ClosesRowsThatAreOffByMoreThanTheirErrors) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3(2, 1.5, 1), 10, Facing::inwards);
  const Index n_walls = mesh.size();
  add_grid(mesh, Vec3(0.5, 0.2, 0.2), 0.6 * Vec3::UnitY(), 0.6 * Vec3::UnitZ(), 6, 6);
  const Room room(std::move(mesh));
  const TransportOptions options{.tolerance = 1e-2, .closed = Closed::yes};
  const auto compressed = make_compressed_transport(room.mesh, room.visibility, options);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(room.mesh.size());
  compressed->set_multipliers({});
  const Eigen::VectorXd before = compressed->apply(ones);
  // Rows that see the screen's front or nothing of it, and one that has 0.3 of a row too much.
  std::vector<std::int32_t> spoilt;
  for (std::int32_t i = 0; i < n_walls && spoilt.size() < 20; i += 7) {
    if (std::abs(before[i] - 1) < 1e-2) spoilt.push_back(i);
  }
  Eigen::VectorXd lacking = Eigen::VectorXd::Zero(room.mesh.size());
  for (std::size_t k = 0; k < spoilt.size(); ++k) {
    lacking[spoilt[k]] = (k % 2 == 0 ? 0.3 : -0.3) * room.mesh.area[spoilt[k]];
  }
  compressed->add_source({{static_cast<std::int32_t>(n_walls)}, lacking});
  const ClosedSums sums = find_closed_sums(*compressed, room.mesh, room.visibility, options);
  close_blocks(*compressed, sums);
  const Eigen::VectorXd after = compressed->apply(ones);
  for (const std::int32_t i : spoilt) {
    EXPECT_EQ(sums.mask[i], 1);
    EXPECT_NEAR(after[i], 1, 1e-3);
  }
  Index n_blocked = 0;
  for (Index i = 0; i < n_walls; ++i) {
    if (before[i] > 0.8) continue;
    ++n_blocked;
    EXPECT_NEAR(after[i], before[i], 0.05);
  }
  EXPECT_GT(n_blocked, 10);
}

TEST(CompressedTransport, TakesLightThatItWasNotMadeFor) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const Room room(meshing::make_patches(scene, {.n_patches = 1500}));
  const TransportOptions options{.tolerance = 5e-2};
  const Eigen::MatrixXd emitted = exitance(scene, room.mesh);
  const auto dense = make_dense_transport(room.mesh, room.visibility, {.tolerance = 1e-3});
  const auto compressed = make_compressed_transport(room.mesh, room.visibility, options);
  const Eigen::MatrixXd expected = dense->apply(emitted);
  const double before = difference(*dense, compressed->apply(emitted), expected);
  add_missing_light(*compressed, room.mesh, room.visibility, options, emitted);
  // As when it is made for this light.
  const double off = difference(*dense, compressed->apply(emitted), expected);
  EXPECT_LT(off, 0.1 * 5e-2);
  EXPECT_GT(before, 3 * off);
  EXPECT_TRUE(compressed->report().compression);
  // Once there it stays as it is.
  const Eigen::MatrixXd gathered = compressed->apply(emitted);
  add_missing_light(*compressed, room.mesh, room.visibility, options, 2 * emitted);
  EXPECT_EQ(compressed->apply(emitted), gathered);
}

TEST(CompressedTransport, StaysClosedWithOtherLight) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/l-room.json");
  const Room room(meshing::make_patches(scene, {.n_patches = 1000}));
  const TransportOptions options{.tolerance = 5e-2, .closed = Closed::yes};
  const auto compressed = make_compressed_transport(room.mesh, room.visibility, options);
  const Index n = room.mesh.size();
  const auto mean_gap = [&] {
    return (compressed->apply(Eigen::VectorXd::Ones(n)).array() - 1).abs().mean();
  };
  const double before = mean_gap();
  add_missing_light(*compressed, room.mesh, room.visibility, options, exitance(scene, room.mesh));
  EXPECT_EQ(compressed->parts().sources.size(), 1U);
  EXPECT_TRUE(compressed->report().closed);
  EXPECT_LT(mean_gap(), std::max(2 * before, 1e-4));
  for (Index i = 0; i < n; i += 97) {
    EXPECT_EQ(compressed->pair(i, n - 1 - i).value, compressed->pair(n - 1 - i, i).value);
  }
}

TEST(CompressedTransport, LeavesSealedRoomsDark) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 14, Facing::inwards);
  const Index n_first = mesh.size();
  add_box(mesh, Vec3(1, 0, 0), Vec3(2, 1, 1), 14, Facing::inwards);
  const Room rooms(std::move(mesh));
  const auto compressed =
      make_compressed_transport(rooms.mesh, rooms.visibility, {.tolerance = 1e-2});
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rooms.mesh.size());
  b.head(n_first).setOnes();
  const Eigen::VectorXd gathered = compressed->apply(b);
  EXPECT_EQ(gathered.tail(rooms.mesh.size() - n_first).cwiseAbs().maxCoeff(), 0);
  EXPECT_LT((gathered.head(n_first).array() - 1).abs().maxCoeff(), 5e-2);
}

/// Two cubes with a slit of their whole height in the wall between: n x n patches a wall.
/// `n_first` are those of the first room.
struct SlitRooms {
  SlitRooms(int n, double width, double place) {
    const Vec3 x = Vec3::UnitX();
    const Vec3 y = Vec3::UnitY();
    const Vec3 z = Vec3::UnitZ();
    for (const int room : {0, 1}) {
      const Vec3 corner = room * x;
      add_grid(mesh, corner, x, y, n, n);
      add_grid(mesh, corner + z, y, x, n, n);
      add_grid(mesh, corner, z, x, n, n);
      add_grid(mesh, corner + y, x, z, n, n);
      const Vec3 beyond = (place + width) * y;
      if (room == 0) {
        add_grid(mesh, corner, y, z, n, n);
        add_grid(mesh, x, z, place * y, n, n / 2);
        add_grid(mesh, x + beyond, z, y - beyond, n, n / 2);
        n_first = mesh.size();
      } else {
        add_grid(mesh, corner + x, z, y, n, n);
        add_grid(mesh, x, place * y, z, n / 2, n);
        add_grid(mesh, x + beyond, y - beyond, z, n / 2, n);
      }
    }
  }
  PatchMesh mesh;
  Index n_first = 0;
};

TEST(CompressedTransport, LetsLightThroughASlitWithinItsErrors) {
  // Walls of B = 1 send through an opening, whatever it leads to, its area.
  for (const auto& [width, place] : {std::pair{0.002, 0.437}, {0.002, 0.11}, {0.03, 0.5}}) {
    SlitRooms rooms(14, width, place);
    const Visibility visibility(rooms.mesh);
    const auto compressed = make_compressed_transport(rooms.mesh, visibility, {.tolerance = 1e-2});
    Eigen::VectorXd b = Eigen::VectorXd::Zero(rooms.mesh.size());
    b.head(rooms.n_first).setOnes();
    const Index n_second = rooms.mesh.size() - rooms.n_first;
    const Eigen::VectorXd area = compressed->area().tail(n_second);
    const double passed = area.dot(compressed->apply(b).col(0).tail(n_second));
    const double error = area.dot(compressed->apply_error(b).col(0).tail(n_second));
    EXPECT_LE(std::abs(passed - width), error) << width << " at " << place;
    EXPECT_LE(error, 1e-2 * area.sum());
  }
}

TEST(CompressedTransport, IsVerifiedAmongHousesThatHideAllButGaps) {
  // Samples that are all but hidden say little of the pairs that see each other along a street.
  // What is verified is a limit of 95 %: one of several may be beyond, but not by much.
  PatchMesh mesh;
  for (int k = 0; k < 25; ++k) {
    const double height = 9 + 3 * (k * k % 7);
    const int row = k / 5;
    const Vec3 corner(30.0 * (k % 5), 30.0 * row, 0);
    add_box(mesh, corner, corner + Vec3(18, 18, height), 2, Facing::outwards);
    add_grid(mesh, corner + Vec3(18, 0, 0), 12 * Vec3::UnitX(), 30 * Vec3::UnitY(), 2, 4);
    add_grid(mesh, corner + Vec3(0, 18, 0), 18 * Vec3::UnitX(), 12 * Vec3::UnitY(), 3, 2);
  }
  const Room town(std::move(mesh));
  const auto dense = make_dense_transport(town.mesh, town.visibility, {.tolerance = 1e-3});
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(town.mesh.size());
  for (const double tolerance : {1e-2, 3e-3}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto compressed = make_compressed_transport(town.mesh, town.visibility,
                                                        {.tolerance = tolerance, .seed = seed});
      EXPECT_LE(difference(*dense, compressed->apply(ones), dense->apply(ones)),
                1.5 * compressed->report().compression->verified_error)
          << tolerance << ", seed " << seed;
    }
  }
}

TEST(CompressedTransport, LeavesCoveredPatchesDark) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 10, Facing::inwards);
  add_box(mesh, Vec3(0.3, 0.3, 0), Vec3(0.7, 0.7, 0.4), 4, Facing::outwards);
  const Room room(std::move(mesh));
  const auto compressed =
      make_compressed_transport(room.mesh, room.visibility, {.tolerance = 1e-2});
  const Eigen::VectorXd& covered = compressed->report().covered;
  ASSERT_TRUE(compressed->report().closed);
  ASSERT_EQ((covered.array() == 1).count(), 2 * 4 * 4);
  const Eigen::VectorXd gathered = compressed->apply(Eigen::VectorXd::Ones(room.mesh.size()));
  for (Index i = 0; i < room.mesh.size(); ++i) {
    if (covered[i] < 1) continue;
    EXPECT_EQ(gathered[i], 0) << i;
  }
}

TEST(CompressedTransport, CountsNoRowsAsOpenThatSeeBacks) {
  // A screen whose back takes what a fifth of the room sends there.
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 10, Facing::inwards);
  add_grid(mesh, Vec3(0.5, 0.2, 0.2), 0.6 * Vec3::UnitY(), 0.6 * Vec3::UnitZ(), 6, 6);
  const Room room(std::move(mesh));
  const TransportOptions options{.tolerance = 1e-2, .closed = Closed::yes};
  const auto compressed = make_compressed_transport(room.mesh, room.visibility, options);
  const AssemblyReport& report = compressed->report();
  ASSERT_TRUE(report.closed);
  const Index n_blocked = ((1 - report.row_sums.array()) > 0.1).count();
  EXPECT_GT(n_blocked, room.mesh.size() / 10);
  EXPECT_GT((report.backs.array() > 0.1).count(), n_blocked / 2);
  // But for a few whose rays pass where walls meet.
  EXPECT_LT(report.open_rows, n_blocked / 10);
}

TEST(CompressedTransport, MayHaveNoPatches) {
  const Room room{PatchMesh{}};
  const auto compressed = make_compressed_transport(room.mesh, room.visibility);
  EXPECT_EQ(compressed->size(), 0);
  EXPECT_EQ(compressed->apply(Eigen::MatrixXd(0, 2)).cols(), 2);
  EXPECT_EQ(compressed->error(), 0);
  EXPECT_EQ(compressed->report().open_rows, 0);
}

// Who waits for an operator is given rougher ones, of which each tells truly how rough it is; what
// is made in the end is not changed by it.
TEST_F(CompressedTransportOfARoom, IsGivenRoughlyOnTheWay) {
  const auto dense = make_dense_transport(room_->mesh, room_->visibility, {.tolerance = 1e-3});
  std::vector<std::unique_ptr<Transport>> rough;
  const auto made = make_compressed_transport(
      room_->mesh, room_->visibility,
      {.tolerance = 1e-2, .rough = [&](std::unique_ptr<Transport> transport) {
         rough.push_back(std::move(transport));
       }});
  ASSERT_FALSE(rough.empty());
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(dense->size(), 1);
  for (const auto& transport : rough) {
    const CompressionReport& report = transport->report().compression.value();
    EXPECT_GT(report.verified_error, 1e-2);
    EXPECT_LE(difference(*dense, transport->apply(ones), dense->apply(ones)),
              report.verified_error);
  }
  EXPECT_LT(rough.front()->report().compression->entries, made->report().compression->entries / 2);
  const Eigen::VectorXd uneven = Eigen::VectorXd::LinSpaced(dense->size(), 0, 1);
  EXPECT_EQ(made->apply(uneven), compressed_->apply(uneven));
  EXPECT_EQ(made->apply_error(ones), compressed_->apply_error(ones));
  EXPECT_EQ(made->report().compression->verified_error,
            compressed_->report().compression->verified_error);
}

// One for almost the same tolerance would be no help.
TEST(CompressedTransport, GivesNothingRoughWhereLittleIsAsked) {
  const Room room(box_in_box(6, 3));
  int n_given = 0;
  make_compressed_transport(
      room.mesh, room.visibility,
      {.tolerance = 0.1, .rough = [&](const std::unique_ptr<Transport>&) { ++n_given; }});
  EXPECT_EQ(n_given, 0);
}

TEST(CompressedTransport, RefusesWhatWillNotFit) {
  const Room room(box_in_box(4, 2));
  try {
    make_compressed_transport(room.mesh, room.visibility, {.memory = 1000});
    FAIL();
  } catch (const SolveError& error) {
    EXPECT_NE(std::string(error.what()).find("--patches"), std::string::npos) << error.what();
  }
}

TEST(CompressedTransport, StopsWhenAsked) {
  const Room room(box_in_box(8, 4));
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(make_compressed_transport(room.mesh, room.visibility,
                                         {.progress = {.report = {}, .stop = source.get_token()}}),
               Interrupted);
}

}  // namespace
}  // namespace radiosity
