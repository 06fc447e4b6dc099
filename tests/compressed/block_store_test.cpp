#include "radiosity/compressed/block_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <stop_token>

#include "radiosity/base/error.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "tests/support/scratch_files.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

namespace fs = std::filesystem;

/// An operator of a room, by way of a work file.
class ResumedBlocks : public ScratchFiles {
 protected:
  ResumedBlocks() : mesh_(test::box_in_box(14, 7)), visibility_(mesh_) {}

  [[nodiscard]] fs::path path() const { return folder() / "f.h5.partial"; }

  /// F of light that no symmetry helps, which has all bits of the operator.
  [[nodiscard]] Eigen::MatrixXd gathered(const TransportOptions& options,
                                         const std::function<void(double)>& reported = {}) const {
    TransportOptions with_file = options;
    with_file.work_file = path();
    with_file.progress.report = [&](std::string_view stage, double done, double, std::string_view) {
      if (reported && stage == "form factors") reported(done);
    };
    const auto transport = make_compressed_transport(mesh_, visibility_, with_file);
    return transport->apply(Eigen::VectorXd::LinSpaced(mesh_.size(), 0, 1).cwiseSqrt());
  }

  PatchMesh mesh_;
  Visibility visibility_;
};

TEST_F(ResumedBlocks, HaveTheSameBitsWhereverTheyWereStopped) {
  const TransportOptions options{.tolerance = 1e-2};
  double n_reports = 0;
  const Eigen::MatrixXd expected = gathered(options, [&](double) { ++n_reports; });
  const auto whole = fs::file_size(path());
  ASSERT_GT(n_reports, 100);
  for (const double share : {0.1, 0.7}) {
    double n = 0;
    std::stop_source stop;
    TransportOptions stopped = options;
    stopped.progress.stop = stop.get_token();
    EXPECT_THROW((void)gathered(stopped,
                                [&](double) {
                                  if (++n > share * n_reports) stop.request_stop();
                                }),
                 Interrupted);
    EXPECT_LE(fs::file_size(path()), whole);
    TransportOptions resumed = options;
    resumed.work_start = WorkStart::resumed;
    EXPECT_EQ(gathered(resumed), expected) << share;
    EXPECT_EQ(fs::file_size(path()), whole);
  }
}

TEST_F(ResumedBlocks, GoOnAfterATornOrSpoiltRecord) {
  const TransportOptions options{.tolerance = 1e-2, .work_start = WorkStart::resumed};
  const Eigen::MatrixXd expected = gathered(options);
  const auto whole = fs::file_size(path());
  std::mt19937_64 random(5);  // NOLINT: fixed seed
  for (int trial = 0; trial < 2; ++trial) {
    const auto place =
        std::uniform_int_distribution<std::uintmax_t>(sizeof(WorkStamp), whole - 1)(random);
    SCOPED_TRACE(place);
    if (trial % 2 == 0) {
      fs::resize_file(path(), place);
    } else {
      std::fstream file(path(), std::ios::binary | std::ios::in | std::ios::out);
      file.seekg(static_cast<std::streamoff>(place));
      const auto flipped = static_cast<char>(~file.get());
      file.seekp(static_cast<std::streamoff>(place));
      file.put(flipped);
    }
    EXPECT_EQ(gathered(options), expected);
    EXPECT_EQ(fs::file_size(path()), whole);
  }
}

TEST_F(ResumedBlocks, BelongToOneComputation) {
  const TransportOptions options{.tolerance = 3e-2, .work_start = WorkStart::resumed};
  (void)gathered(options);
  TransportOptions other = options;
  other.seed = 1;
  EXPECT_THROW((void)gathered(other), OutputError);
  const std::uint64_t fingerprint = compressed_fingerprint(mesh_, options, {}).value();
  EXPECT_EQ(block_file_state(path(), fingerprint), WorkFileState::same);
  EXPECT_EQ(block_file_state(path(), fingerprint + 1), WorkFileState::other);
  other.work_start = WorkStart::anew;
  (void)gathered(other);
  EXPECT_EQ(block_file_state(path(), fingerprint), WorkFileState::other);
  // A work file of tiles is that of another computation, too; others' files are none.
  std::ofstream(path()) << "RADTILE1........";
  EXPECT_EQ(block_file_state(path(), fingerprint), WorkFileState::other);
  std::ofstream(path()) << "somebody's notes";
  EXPECT_THROW((void)block_file_state(path(), fingerprint), OutputError);
}

}  // namespace
}  // namespace radiosity
