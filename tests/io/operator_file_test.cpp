// Operators written to files and read back, damaged ones among them.
#include "io/result/operator_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/damaged_files.h"
#include "tests/support/output_folder.h"
#include "tests/support/scratch_files.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::file_bytes;
using test::write_bytes;

constexpr double kTolerance = 3e-2;

/// Columns that tell operators apart.
Eigen::MatrixXd test_light(Index n) {
  Eigen::MatrixXd light(n, 3);
  for (Index i = 0; i < n; ++i) {
    light.row(i) << 1, static_cast<double>(i % 7), static_cast<double>(i % 13 == 0);
  }
  return light;
}

class OperatorFile : public OutputFolder {
 protected:
  static void SetUpTestSuite() {
    const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
    mesh_ = new PatchMesh(meshing::make_patches(scene, {.n_patches = 350}));
    const Visibility visibility(*mesh_);
    compressed_ = make_compressed_transport(*mesh_, visibility, {.tolerance = kTolerance},
                                            {exitance(scene, *mesh_), reflectance(scene, *mesh_)})
                      .release();
  }
  static void TearDownTestSuite() {
    delete compressed_;
    delete mesh_;
  }

  OperatorFile() {
    io::write_operator(path_, *mesh_, *compressed_, {.tolerance = kTolerance, .geometry = "abc"});
  }

  /// Reads it and does all that reads its numbers.
  static void use(const std::filesystem::path& path) {
    const io::StoredOperator stored = io::read_operator(path);
    const Index n = stored.mesh.size();
    (void)stored.transport->apply(test_light(n));
    (void)stored.transport->apply_error(test_light(n));
    (void)rows_of(*stored.transport).row(n / 2);
    (void)rows_of(*stored.transport).pair(n / 3, n / 2);
  }
  static std::string error_of(const std::filesystem::path& path) {
    return test::refusal<SceneError>(path, use);
  }
  /// The file with other values of a dataset, whose checksums are right.
  template <typename Change>
  [[nodiscard]] std::filesystem::path changed(const char* name, hid_t type,
                                              const Change& change) const {
    const auto copy = folder() / "changed.h5";
    write_bytes(copy, file_bytes(path_));
    const hid_t file = H5Fopen(copy.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    EXPECT_GE(set, 0) << name;
    const hid_t space = H5Dget_space(set);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    change(values);
    EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Sclose(space);
    H5Dclose(set);
    EXPECT_GE(H5Fclose(file), 0);
    return copy;
  }
  [[nodiscard]] std::filesystem::path with_value(const char* name, std::size_t place,
                                                 double value) const {
    return changed(name, H5T_NATIVE_DOUBLE, [&](std::vector<double>& values) {
      ASSERT_LT(place, values.size()) << name;
      values[place] = value;
    });
  }

  inline static PatchMesh* mesh_ = nullptr;
  inline static CompressedTransport* compressed_ = nullptr;
  const std::filesystem::path path_ = folder() / "o.h5";
};

TEST_F(OperatorFile, GivesBackACompressedOneToTheLastBit) {
  const io::StoredOperator stored = io::read_operator(path_);
  const Eigen::MatrixXd light = test_light(mesh_->size());
  EXPECT_EQ(stored.transport->apply(light), compressed_->apply(light));
  EXPECT_EQ(stored.transport->apply_error(light), compressed_->apply_error(light));
  EXPECT_EQ(stored.transport->error(), compressed_->error());
  EXPECT_EQ(stored.transport->bytes(), compressed_->bytes());
  EXPECT_EQ(rows_of(*stored.transport).row(5), compressed_->row(5));
  EXPECT_EQ(stored.tolerance, kTolerance);
  EXPECT_EQ(stored.geometry, "abc");
  const AssemblyReport& report = stored.transport->report();
  const AssemblyReport& expected = compressed_->report();
  EXPECT_EQ(report.row_sums, expected.row_sums);
  EXPECT_EQ(report.covered, expected.covered);
  EXPECT_EQ(report.backs, expected.backs);
  EXPECT_EQ(report.closed, expected.closed);
  EXPECT_EQ(report.undecided, expected.undecided);
  EXPECT_EQ(report.closure_max, expected.closure_max);
  ASSERT_TRUE(report.compression);
  EXPECT_EQ(report.compression->verified_error, expected.compression->verified_error);
}

TEST_F(OperatorFile, SameInputGivesTheSameBytes) {
  io::write_operator(folder() / "p.h5", *mesh_, *compressed_,
                     {.tolerance = kTolerance, .geometry = "abc"});
  EXPECT_EQ(file_bytes(folder() / "p.h5"), file_bytes(path_));
  // Read and written again, too.
  const io::StoredOperator stored = io::read_operator(path_);
  io::write_operator(folder() / "q.h5", stored.mesh, *stored.transport,
                     {.tolerance = stored.tolerance, .geometry = stored.geometry});
  EXPECT_EQ(file_bytes(folder() / "q.h5"), file_bytes(path_));
}

/// Entries have single precision, sums are kept beside them.
TEST_F(OperatorFile, GivesBackADenseOneToRounding) {
  for (const PatchMesh& mesh : {test::box_in_box(4, 2), test::box_in_box(10, 4)}) {
    const Visibility visibility(mesh);
    const auto dense = make_transport(mesh, visibility);
    io::write_operator(folder() / "d.h5", mesh, *dense, {.tolerance = 1e-2, .geometry = "abc"});
    const io::StoredOperator stored = io::read_operator(folder() / "d.h5");
    const Eigen::MatrixXd light = test_light(mesh.size());
    const Eigen::MatrixXd expected = dense->apply(light);
    EXPECT_LT((stored.transport->apply(light) - expected).cwiseAbs().maxCoeff(),
              1e-13 * expected.maxCoeff());
    EXPECT_TRUE(stored.transport->apply_error(light).isApprox(dense->apply_error(light), 1e-6));
    EXPECT_NEAR(stored.transport->error(), dense->error(), 1e-6 * dense->error());
    EXPECT_LE(stored.transport->bytes(), 2 * dense->bytes());
    EXPECT_EQ(stored.transport->report().backs, dense->report().backs);
    EXPECT_FALSE(stored.transport->report().compression);
  }
}

TEST_F(OperatorFile, KeepsWhatPatchesArePartsOf) {
  PatchMesh mesh = test::box_in_box(4, 2);
  mesh.precision = 1e-9;
  mesh.family.assign(mesh.family.size(), 3);
  mesh.polygon_corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(2, 1, 0)};
  mesh.polygon.assign(mesh.polygon.size(), 1);
  mesh.first_polygon_corner = {0, 1, 4};
  const Visibility visibility(mesh);
  io::write_operator(path_, mesh, *make_transport(mesh, visibility));
  const PatchMesh read = io::read_operator(path_).mesh;
  EXPECT_EQ(read.precision, mesh.precision);
  EXPECT_EQ(read.family, mesh.family);
  EXPECT_EQ(read.polygon_corners, mesh.polygon_corners);
  EXPECT_EQ(read.first_polygon_corner, mesh.first_polygon_corner);
}

TEST_F(OperatorFile, ExplainsWhatIsNoFile) {
  EXPECT_CONTAINS(error_of(folder() / "gone.h5"), "no such file");
  write_bytes(folder() / "a.h5", "patch,surface,polygon\n");
  EXPECT_CONTAINS(error_of(folder() / "a.h5"), "is not an operator or form-factor file (HDF5)");
  const hid_t other =
      H5Fcreate((folder() / "b.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(other);
  EXPECT_CONTAINS(error_of(folder() / "b.h5"), "is no form-factor file of this program");
}

TEST_F(OperatorFile, RefusesIndicesThatLeadElsewhere) {
  EXPECT_CONTAINS(error_of(with_value("/compressed/order", 3, 1e6)), "order of the patches");
  EXPECT_CONTAINS(error_of(with_value("/compressed/order", 3, -1)), "order of the patches");
  EXPECT_CONTAINS(error_of(changed("/compressed/order", H5T_NATIVE_DOUBLE,
                                   [](auto& values) { values[1] = values[0]; })),
                  "each of them once");
  for (const std::size_t column : {0U, 1U, 2U, 3U}) {
    for (const double value : {-5.0, 7.0, 1e8}) {
      EXPECT_CONTAINS(error_of(with_value("/compressed/nodes", 4 + column, value)), "tree");
    }
  }
  EXPECT_CONTAINS(error_of(with_value("/compressed/functions", 6, 200)), "degree 0 than one");
  EXPECT_CONTAINS(error_of(with_value("/compressed/functions", 6, 0)), "degree 0 than one");
  EXPECT_CONTAINS(error_of(with_value("/compressed/functions", 7, 200)), "fewer functions");
  EXPECT_CONTAINS(error_of(with_value("/compressed/functions", 11, 0)), "degree 0 than one");
  EXPECT_CONTAINS(error_of(with_value("/compressed/functions", 11, 99)),
                  "numbers of its functions");
  EXPECT_CONTAINS(error_of(with_value("/compressed/far", 0, -1)), "nodes that are not there");
  EXPECT_CONTAINS(error_of(with_value("/compressed/far", 1, 1e8)), "nodes that are not there");
  EXPECT_CONTAINS(error_of(with_value("/compressed/far_degrees", 0, 9)), "its nodes have not");
  EXPECT_CONTAINS(error_of(with_value("/compressed/far_errors", 0, -1)), "standard error below 0");
  EXPECT_CONTAINS(error_of(with_value("/compressed/near", 0, 0)), "not between leaves");
  EXPECT_CONTAINS(error_of(with_value("/compressed/near", 1, 1e8)), "nodes that are not there");
  EXPECT_CONTAINS(error_of(with_value("/compressed/light_patches", 0, -2)), "are not there");
  EXPECT_CONTAINS(error_of(with_value("/compressed/first_light_patch", 0, 1)), "their list");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"/compressed/numbers", "/compressed/coefficients",
                           "/compressed/densities", "/compressed/light", "/covered"}) {
    EXPECT_CONTAINS(error_of(with_value(name, 0, nan)), "not finite");
  }
}

/// Any value anywhere is refused or harmless.
TEST_F(OperatorFile, NeverFallsOverValuesOfAnyKind) {
  std::mt19937_64 random(3);  // NOLINT: fixed seed
  const std::vector<const char*> names = {
      "/compressed/nodes",          "/compressed/functions", "/compressed/far",
      "/compressed/far_degrees",    "/compressed/near",      "/compressed/order",
      "/compressed/near_may_change"};
  for (int trial = 0; trial < 200; ++trial) {
    const char* name = names[random() % names.size()];
    const auto file = changed(name, H5T_NATIVE_DOUBLE, [&](std::vector<double>& values) {
      for (int k = 0; k < 3; ++k) {
        const double value = random() % 2 == 0 ? static_cast<double>(random() % 300)
                                               : values[random() % values.size()];
        values[random() % values.size()] = value;
      }
    });
    (void)test::outcome<SceneError>(file, use);
  }
}

TEST_F(OperatorFile, RefusesFilesThatWereCutOff) {
  const std::string whole = file_bytes(path_);
  [[maybe_unused]] const test::LeaksAllowed allowed;
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 30) {
    write_bytes(folder() / "cut.h5", whole.substr(0, size));
    (void)error_of(folder() / "cut.h5");
  }
}

TEST_F(OperatorFile, NoticesChangedBytes) {
  const std::string whole = file_bytes(path_);
  const Eigen::MatrixXd light = test_light(mesh_->size());
  const Eigen::MatrixXd expected = compressed_->apply(light);
  std::mt19937_64 random(1);  // NOLINT: fixed seed
  [[maybe_unused]] const test::LeaksAllowed allowed;
  H5garbage_collect();  // so that HDF5 does not use again, and lose, what it took before
  int n_refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto flipped = folder() / "flip.h5";
    write_bytes(flipped, test::with_flip(whole, 0, whole.size(), random));
    if (!test::outcome<SceneError>(flipped, use).empty()) {
      ++n_refused;
      continue;
    }
    EXPECT_EQ(io::read_operator(flipped).transport->apply(light), expected) << trial;
  }
  EXPECT_GT(n_refused, 100);
}

}  // namespace
