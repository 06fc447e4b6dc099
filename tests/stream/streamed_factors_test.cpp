#include "radiosity/stream/streamed_factors.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <string>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/streamed_part.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/output_folder.h"
#include "tests/support/shapes.h"
#include "tests/support/thread_ranks.h"

namespace radiosity {
namespace {

namespace fs = std::filesystem;
using Start = TileStore::Start;

constexpr std::size_t kAmple = 100'000'000;
constexpr std::size_t kHardlyAny = 1;

/// F and its standard errors as dense matrices, n x n.
struct Factors {
  Eigen::MatrixXd values;
  Eigen::MatrixXd errors;
  AssemblyReport report;
  DroppedFactors dropped;

  bool operator==(const Factors& other) const {
    return values == other.values && errors == other.errors &&
           report.row_sums == other.report.row_sums && report.rays == other.report.rays &&
           report.facing == other.report.facing && report.closed == other.report.closed;
  }
};

enum class Lid { on, off };

/// Unit cube seen from inside, with or without its ceiling, and a box in it.
PatchMesh box_in_box(int n, Lid lid) {
  PatchMesh mesh;
  test::add_box(mesh, Vec3(0.35, 0.3, 0.25), Vec3(0.65, 0.6, 0.75), n, test::Facing::outwards);
  if (lid == Lid::on) {
    test::add_box(mesh, Vec3::Zero(), Vec3::Ones(), n, test::Facing::inwards);
  } else {
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), n, n);
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), n, n);
  }
  return mesh;
}

class StreamedFactorsTest : public OutputFolder {
 protected:
  [[nodiscard]] fs::path work_file() const { return folder() / "f.h5.partial"; }

  [[nodiscard]] Factors compute(const PatchMesh& mesh, const StreamOptions& options,
                                Start start = Start::anew) const {
    const Visibility visibility(mesh);
    TileStore store(work_file(), stream_fingerprint(mesh, options).value(), start, mesh.area);
    const StreamedFactors streamed(mesh, visibility, options, store);
    const Index n = mesh.size();
    Factors factors{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n), streamed.report(),
                    streamed.dropped()};
    Index next = 0;
    streamed.for_each_row([&](Index i, const Eigen::VectorXd& row, const Eigen::VectorXd& error) {
      EXPECT_EQ(i, next++);
      factors.values.row(i) = row;
      factors.errors.row(i) = error;
    });
    EXPECT_EQ(next, n);
    return factors;
  }
};

TEST_F(StreamedFactorsTest, HaveTheSameBitsOnSeveralRanks) {
  const PatchMesh mesh = box_in_box(4, Lid::on);
  const StreamOptions options{.tolerance = 3e-2, .buffers = kAmple};
  const Factors alone = compute(mesh, options);
  const Visibility visibility(mesh);
  for (const int n_ranks : {2, 5}) {
    // A part of the work is there already, as where other ranks were stopped.
    {
      TileStore store(work_file(), stream_fingerprint(mesh, options).value(), Start::anew,
                      mesh.area);
      make_streamed_part(mesh, visibility, options, {.number = 1, .n_parts = 3}, store);
    }
    test::on_ranks(n_ranks, [&](Ranks& ranks) {
      StreamOptions shared = options;
      shared.ranks = &ranks;
      if (ranks.rank() > 0) return assist_streamed_factors(mesh, visibility, shared);
      EXPECT_TRUE(compute(mesh, shared, Start::resumed) == alone) << n_ranks;
    });
  }
}

double largest_asymmetry(const PatchMesh& mesh, const Eigen::MatrixXd& values) {
  const Eigen::Map<const Eigen::VectorXd> areas(mesh.area.data(), mesh.size());
  const Eigen::MatrixXd exchange = areas.asDiagonal() * values;
  return (exchange - exchange.transpose()).cwiseAbs().maxCoeff() / exchange.maxCoeff();
}

/// Of an eighth of a room and its images; patches see themselves.
TEST_F(StreamedFactorsTest, OfAPartAreThoseOfTheOperatorInMemory) {
  PatchMesh mesh;
  test::add_grid(mesh, Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), 4, 4);
  test::add_grid(mesh, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), 4, 4);
  test::add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 4, 4);
  test::add_box(mesh, Vec3(0.1, 0.15, 0.2), Vec3(0.35, 0.5, 0.45), 2, test::Facing::outwards);
  Symmetry symmetry;
  for (int axis = 0; axis < 3; ++axis) symmetry.mirrors.push_back({Vec3::Zero(), Vec3::Unit(axis)});
  mesh.images = image_motions(symmetry);
  const auto transport =
      make_dense_transport(mesh, Visibility(mesh), {.tolerance = 1e-3, .closed = Closed::no});
  const Factors factors =
      compute(mesh, {.tolerance = 1e-3, .closed = Closed::no, .buffers = kAmple});
  EXPECT_LE(largest_asymmetry(mesh, factors.values), 1e-15);  // of areas and rows, rounded
  EXPECT_GT(factors.values.diagonal().maxCoeff(), 0.01);
  for (Index i = 0; i < mesh.size(); ++i) {
    EXPECT_EQ(factors.values.row(i).transpose(), rows_of(*transport).row(i));
    EXPECT_EQ(factors.errors.row(i).transpose(), rows_of(*transport).row_error(i));
  }
}

TEST_F(StreamedFactorsTest, AreThoseOfTheOperatorInMemory) {
  for (const Lid lid : {Lid::on, Lid::off}) {
    const PatchMesh mesh = box_in_box(4, lid);
    const Visibility visibility(mesh);
    const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3});
    const Factors factors = compute(mesh, {.tolerance = 1e-3, .buffers = kAmple});
    // Uncorrected entries are the same bits. In closed scenes rows without uncertain entries, off
    // by the kernel's 1e-11 of an entry, are balanced in the file only.
    const double allowed = lid == Lid::on ? 1e-11 : 0;
    EXPECT_EQ(factors.report.closed, lid == Lid::on);
    EXPECT_EQ(factors.report.row_sums, transport->report().row_sums);
    EXPECT_EQ(factors.report.undecided, transport->report().undecided);
    EXPECT_GT(factors.report.undecided, 0);
    for (Index i = 0; i < mesh.size(); ++i) {
      EXPECT_LE(
          (factors.values.row(i).transpose() - rows_of(*transport).row(i)).cwiseAbs().maxCoeff(),
          allowed);
      EXPECT_EQ(factors.errors.row(i).transpose(), rows_of(*transport).row_error(i));
    }
  }
}

TEST_F(StreamedFactorsTest, AreReciprocalAndClosed) {
  const PatchMesh mesh = box_in_box(7, Lid::on);  // more rows than are float64 in memory
  const Factors factors = compute(mesh, {.tolerance = 1e-2, .buffers = kAmple});
  ASSERT_TRUE(factors.report.closed);
  EXPECT_EQ(factors.report.open_rows, 0);
  EXPECT_LT((factors.values.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-10);
  EXPECT_GE(factors.values.minCoeff(), 0);
  EXPECT_LE(largest_asymmetry(mesh, factors.values), 4 * std::numeric_limits<double>::epsilon());
}

TEST_F(StreamedFactorsTest, DependNeitherOnThreadsNorOnMemory) {
  for (const double min_factor : {0.0, 1e-3}) {
    const PatchMesh mesh = box_in_box(4, Lid::on);
    const StreamOptions ample{
        .tolerance = 1e-2, .min_factor = min_factor, .buffers = kAmple, .progress = {}};
    StreamOptions sparing = ample;
    sparing.buffers = kHardlyAny;  // a pass for each row, and no entries kept in memory
    const Factors all_cores = compute(mesh, ample);
    const ThreadLimit one(1);
    EXPECT_EQ(compute(mesh, ample), all_cores);
    EXPECT_EQ(compute(mesh, sparing), all_cores);
  }
}

TEST_F(StreamedFactorsTest, GoOnAfterATornOrSpoiltRecord) {
  const PatchMesh mesh = box_in_box(5, Lid::on);
  const StreamOptions options{.tolerance = 1e-2, .buffers = kAmple};
  const Factors expected = compute(mesh, options);
  const auto whole = fs::file_size(work_file());
  std::mt19937_64 random(5);  // NOLINT: fixed seed
  for (int trial = 0; trial < 8; ++trial) {
    const auto place = std::uniform_int_distribution<std::uintmax_t>(16, whole - 1)(random);
    SCOPED_TRACE(place);
    if (trial % 2 == 0) {
      fs::resize_file(work_file(), place);
    } else {
      std::fstream file(work_file(), std::ios::binary | std::ios::in | std::ios::out);
      file.seekg(static_cast<std::streamoff>(place));
      const auto flipped = static_cast<char>(~file.get());
      file.seekp(static_cast<std::streamoff>(place));
      file.put(flipped);
    }
    EXPECT_EQ(compute(mesh, options, Start::resumed), expected);
    EXPECT_EQ(fs::file_size(work_file()), whole);
  }
}

TEST_F(StreamedFactorsTest, NothingIsComputedTwice) {
  const PatchMesh mesh = box_in_box(4, Lid::on);
  StreamOptions options{.tolerance = 1e-2, .buffers = kAmple};
  const Factors expected = compute(mesh, options);
  std::vector<double> reports;
  options.progress.report = [&](std::string_view stage, double done, double, std::string_view) {
    if (stage == "form factors") reports.push_back(done);
  };
  EXPECT_EQ(compute(mesh, options, Start::resumed), expected);
  const auto n = static_cast<double>(mesh.size());
  EXPECT_EQ(reports, std::vector<double>{0.5 * n * (n - 1)});
}

TEST_F(StreamedFactorsTest, FullDiskIsAnErrorAndKeepsTheWork) {
  const PatchMesh mesh = box_in_box(4, Lid::on);
  const StreamOptions options{.tolerance = 1e-2, .buffers = kAmple};
  const Factors expected = compute(mesh, options);
  const auto whole = fs::file_size(work_file());
  {
    const SmallDisk disk(whole / 2);
    EXPECT_THROW((void)compute(mesh, options), OutputError);
  }
  EXPECT_LE(fs::file_size(work_file()), whole / 2);
  EXPECT_GT(fs::file_size(work_file()), 0U);
  EXPECT_EQ(compute(mesh, options, Start::resumed), expected);
}

TEST_F(StreamedFactorsTest, WorkFileBelongsToOneComputationAndOneRun) {
  const PatchMesh mesh = box_in_box(1, Lid::on);
  const auto path = work_file();
  EXPECT_EQ(work_file_state(path, 1), WorkFileState::absent);
  const TileStore store(path, 1, Start::anew, mesh.area);
  EXPECT_THROW(TileStore(path, 1, Start::resumed, mesh.area), OutputError);
  const auto other = folder() / "other.partial";
  { const TileStore closed(other, 1, Start::anew, mesh.area); }
  EXPECT_EQ(work_file_state(other, 1), WorkFileState::same);
  EXPECT_EQ(work_file_state(other, 2), WorkFileState::other);
  fs::resize_file(other, 5);  // stopped within the header
  EXPECT_EQ(work_file_state(other, 1), WorkFileState::absent);
  std::ofstream(other) << "somebody's notes";
  EXPECT_THROW(work_file_state(other, 1), OutputError);
}

TEST_F(StreamedFactorsTest, FingerprintTellsApartWhatChangesTheResult) {
  const PatchMesh mesh = box_in_box(2, Lid::on);
  const auto of = [](const PatchMesh& patches, const StreamOptions& options) {
    return stream_fingerprint(patches, options).text();
  };
  const std::string fingerprint = of(mesh, {});
  EXPECT_EQ(fingerprint.size(), 16U);
  EXPECT_EQ(of(mesh, {.buffers = kAmple}), fingerprint);
  EXPECT_NE(of(mesh, {.tolerance = 2e-3}), fingerprint);
  EXPECT_NE(of(mesh, {.closed = Closed::no}), fingerprint);
  EXPECT_NE(of(mesh, {.seed = 1}), fingerprint);
  EXPECT_NE(of(mesh, {.min_factor = 1e-6}), fingerprint);
  PatchMesh changed = mesh;
  changed.surface_names.front() = "another name";
  EXPECT_NE(of(changed, {}), fingerprint);
  changed = mesh;
  changed.vertices.back().x() += 1e-12;
  EXPECT_NE(of(changed, {}), fingerprint);
  EXPECT_NE(of(box_in_box(3, Lid::on), {}), fingerprint);
}

TEST_F(StreamedFactorsTest, DroppingSmallPairsKeepsRowSumsAndReciprocity) {
  constexpr double kMinFactor = 4e-3;
  for (const Lid lid : {Lid::on, Lid::off}) {
    const PatchMesh mesh = box_in_box(4, lid);
    const Factors all = compute(mesh, {.tolerance = 1e-2, .buffers = kAmple});
    const Factors kept =
        compute(mesh, {.tolerance = 1e-2, .min_factor = kMinFactor, .buffers = kAmple});
    const Eigen::VectorXd sums = all.values.rowwise().sum();
    ASSERT_EQ(kept.dropped.unbalanced_rows, 0);
    EXPECT_LT((kept.values.rowwise().sum() - sums).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_GE(kept.values.minCoeff(), 0);
    EXPECT_LE(largest_asymmetry(mesh, kept.values), 4 * std::numeric_limits<double>::epsilon());

    const auto small = [&](Index i, Index j) {
      return all.values(i, j) < kMinFactor && all.values(j, i) < kMinFactor;
    };
    std::int64_t n_dropped = 0;
    double dropped = 0;
    double total = 0;
    double largest = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      double of_row = 0;
      for (Index j = 0; j < mesh.size(); ++j) {
        total += mesh.area[i] * all.values(i, j);
        if (!small(i, j)) continue;
        EXPECT_EQ(kept.values(i, j), 0);
        EXPECT_EQ(kept.errors(i, j), 0);
        n_dropped += all.values(i, j) > 0 || all.errors(i, j) > 0 ? 1 : 0;
        of_row += all.values(i, j);
      }
      dropped += mesh.area[i] * of_row;
      largest = std::max(largest, of_row / sums[i]);
    }
    EXPECT_GT(n_dropped, 0);
    EXPECT_EQ(kept.dropped.entries, n_dropped);
    EXPECT_NEAR(kept.dropped.share, dropped / total, 1e-12);
    EXPECT_NEAR(kept.dropped.largest_row_share, largest, 1e-12);
  }
}

TEST_F(StreamedFactorsTest, RowsOfWhichNothingIsKeptAreCounted) {
  PatchMesh mesh;  // two small squares far from each other, and nothing else
  test::add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
  test::add_grid(mesh, Vec3(0, 0, 9), Vec3::UnitY(), Vec3::UnitX(), 1, 1);
  const Factors factors = compute(mesh, {.min_factor = 0.1, .buffers = kAmple});
  EXPECT_EQ(factors.values, Eigen::MatrixXd::Zero(2, 2));
  EXPECT_EQ(factors.dropped.entries, 2);
  EXPECT_EQ(factors.dropped.unbalanced_rows, 2);
  EXPECT_NEAR(factors.dropped.share, 1, 1e-12);
}

}  // namespace
}  // namespace radiosity
