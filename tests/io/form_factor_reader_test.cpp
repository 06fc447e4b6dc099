#include "io/result/form_factor_reader.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/result/form_factor_file.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/damaged_files.h"
#include "tests/support/output_folder.h"
#include "tests/support/scratch_files.h"
#include "tests/support/shapes.h"

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kAllocatorPrints = true;
#else
constexpr bool kAllocatorPrints = false;
#endif

namespace {

using namespace radiosity;
using test::file_bytes;
using test::write_bytes;

/// A two-sided sheet in a box, and a triangle below it.
PatchMesh boxed_sheet() {
  PatchMesh mesh;
  test::add_box(mesh, Vec3::Zero(), Vec3(1, 1. / 3, 1), 2, test::Facing::inwards);
  const auto sheet =
      test::add_grid(mesh, Vec3(0.3, 0.1, 0.5), Vec3(0.4, 0, 0), Vec3(0, 0.1, 0.1), 2, 1);
  test::make_two_sided(mesh, sheet);
  mesh.surface_names.emplace_back("dreieck ü");
  mesh.surface_two_sided.push_back(false);
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vec3& corner : {Vec3(0.2, 0.1, 0.2), Vec3(0.6, 0.1, 0.2), Vec3(0.6, 0.2, 0.2)}) {
    mesh.vertices.push_back(corner);
  }
  mesh.add_patch({first, first + 1, first + 2, -1}, sheet + 1, 99);
  return mesh;
}

class FormFactorReader : public OutputFolder {
 protected:
  FormFactorReader() {
    io::write_form_factors(path_, mesh_, *transport_,
                           {.tolerance = 2e-3, .min_factor = 1e-9, .fingerprint = "abc"});
  }

  /// Reads the whole of a file.
  static void read_everything(const std::filesystem::path& path) {
    const io::FormFactorReader reader(path);
    for (Index i = 0; i < reader.size(); ++i) {
      (void)reader.row(i);
      (void)reader.row_error(i);
    }
  }
  static std::string error_of(const std::filesystem::path& path) {
    return test::refusal<SceneError>(path, read_everything);
  }
  /// The file after `change`.
  [[nodiscard]] std::filesystem::path changed(const std::function<void(hid_t)>& change) const {
    const auto copy = folder() / "changed.h5";
    write_bytes(copy, file_bytes(path_));
    const hid_t file = H5Fopen(copy.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    EXPECT_GE(H5Fclose(file), 0);
    return copy;
  }
  /// The file without some of its parts.
  [[nodiscard]] std::filesystem::path without(const std::vector<const char*>& names) const {
    return changed([&](hid_t file) {
      for (const char* name : names) EXPECT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0) << name;
    });
  }
  /// The file with the first value of a dataset changed.
  [[nodiscard]] std::filesystem::path with_value(const char* name, double value) const {
    return changed([&](hid_t file) {
      const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
      const hid_t space = H5Dget_space(set);
      const hsize_t start[] = {0, 0};
      const hsize_t count[] = {1, 1};
      const hsize_t one = 1;
      const hid_t memory = H5Screate_simple(1, &one, nullptr);
      H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
      EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, &value), 0) << name;
      H5Sclose(memory);
      H5Sclose(space);
      H5Dclose(set);
    });
  }

  const PatchMesh mesh_ = boxed_sheet();
  const Visibility visibility_{mesh_};
  const std::unique_ptr<Transport> transport_ = make_transport(mesh_, visibility_);
  const std::filesystem::path path_ = folder() / "f.h5";
};

TEST_F(FormFactorReader, GivesBackWhatWasWritten) {
  const io::FormFactorReader reader(path_);
  ASSERT_EQ(reader.size(), mesh_.size());
  EXPECT_EQ(reader.mesh().vertices, mesh_.vertices);
  EXPECT_EQ(reader.mesh().corners, mesh_.corners);
  EXPECT_EQ(reader.mesh().surface, mesh_.surface);
  EXPECT_EQ(reader.mesh().polygon, mesh_.polygon);
  EXPECT_EQ(reader.mesh().twin, mesh_.twin);
  EXPECT_EQ(reader.mesh().area, mesh_.area);
  EXPECT_EQ(reader.mesh().normal, mesh_.normal);
  EXPECT_EQ(reader.mesh().centroid, mesh_.centroid);
  EXPECT_EQ(reader.mesh().surface_names, mesh_.surface_names);
  EXPECT_EQ(reader.mesh().surface_two_sided, mesh_.surface_two_sided);
  for (Index i = 0; i < reader.size(); ++i) {
    EXPECT_EQ(reader.row(i), rows_of(*transport_).row(i)) << i;
    EXPECT_EQ(reader.row_error(i), rows_of(*transport_).row_error(i)) << i;
  }
  EXPECT_EQ(reader.closure(), transport_->report().row_sums);
  EXPECT_EQ(reader.tolerance(), 2e-3);
  EXPECT_EQ(reader.min_factor(), 1e-9);
  EXPECT_EQ(reader.closed(), transport_->report().closed);
  EXPECT_EQ(reader.fingerprint(), "abc");
  EXPECT_TRUE(reader.warnings().empty());
}

TEST_F(FormFactorReader, SameInputGivesTheSameBytes) {
  io::write_form_factors(folder() / "g.h5", mesh_, *transport_,
                         {.tolerance = 2e-3, .min_factor = 1e-9, .fingerprint = "abc"});
  EXPECT_EQ(file_bytes(folder() / "g.h5"), file_bytes(path_));
}

/// As files were before they had corners.
TEST_F(FormFactorReader, ShowsSquaresWhereCornersAreMissing) {
  const io::FormFactorReader reader(
      without({"/patches/corners", "/patches/twin", "/vertices", "/surfaces/two_sided"}));
  ASSERT_EQ(reader.warnings().size(), 1U);
  EXPECT_CONTAINS(reader.warnings()[0], "does not have the corners");
  const PatchMesh& read = reader.mesh();
  EXPECT_EQ(read.area, mesh_.area);
  EXPECT_EQ(read.normal, mesh_.normal);
  EXPECT_EQ(read.centroid, mesh_.centroid);
  PatchMesh again = read;
  for (Index i = 0; i < read.size(); ++i) {
    again.add_patch(read.corners[i], 0, 0);
    EXPECT_NEAR(again.area.back(), mesh_.area[i], 1e-14 * mesh_.area[i]);
    EXPECT_LT((again.normal.back() - mesh_.normal[i]).norm(), 1e-14);
    EXPECT_LT((again.centroid.back() - mesh_.centroid[i]).norm(), 1e-15);
    EXPECT_EQ(read.twin[i], -1);
  }
  EXPECT_EQ(reader.row(3), rows_of(*transport_).row(3));
}

TEST_F(FormFactorReader, ExplainsWhatIsNoFile) {
  EXPECT_CONTAINS(error_of(folder() / "gone.h5"), "no such file");
  EXPECT_CONTAINS(error_of(folder()), "is a folder");
  write_bytes(folder() / "a.h5", "patch,surface,polygon\n");
  EXPECT_CONTAINS(error_of(folder() / "a.h5"), "is not a form-factor file (HDF5)");
  EXPECT_CONTAINS(error_of(without({"/patches/area", "/form_factors"})),
                  "is no form-factor file of this program: it lacks /patches/area, "
                  "/form_factors/data, /form_factors/error");
  EXPECT_CONTAINS(error_of(changed([](hid_t file) { H5Adelete(file, "version"); })),
                  "lacks attribute \"version\"");
  EXPECT_CONTAINS(error_of(changed([](hid_t file) {
                    const std::int64_t version = 7;
                    const hid_t attribute = H5Aopen(file, "version", H5P_DEFAULT);
                    H5Awrite(attribute, H5T_NATIVE_INT64, &version);
                    H5Aclose(attribute);
                  })),
                  "was written by a newer version of this program (format 7, this one reads 1)");
}

TEST_F(FormFactorReader, ExplainsValuesThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_CONTAINS(error_of(with_value("/patches/area", -1)), "patch 0 has the area -1 m²");
  EXPECT_CONTAINS(error_of(with_value("/patches/area", 9)),
                  "of 0.08333333333333333 m² by its corn");
  EXPECT_CONTAINS(error_of(with_value("/patches/surface", 8)),
                  "patch 0 is of surface 8, but there are 8");
  EXPECT_CONTAINS(error_of(with_value("/patches/polygon", -1)), "patch 0 is of polygon -1");
  EXPECT_CONTAINS(error_of(with_value("/patches/twin", 5)), "patch 0 has the back 5");
  EXPECT_CONTAINS(error_of(with_value("/patches/corners", 5000)), "patch 0 uses vertex 5000");
  EXPECT_CONTAINS(error_of(with_value("/patches/corners", -1)), "patch 0 uses vertex -1");
  EXPECT_CONTAINS(error_of(with_value("/vertices", nan)),
                  "/vertices has a value that is not finite");
  EXPECT_CONTAINS(error_of(with_value("/closure", nan)), "/closure has a value that is not finite");
  EXPECT_CONTAINS(error_of(with_value("/form_factors/indptr", 2)), "do not make up the list");
  EXPECT_CONTAINS(error_of(with_value("/form_factors/indptr", -2)), "row 0 lies outside");
  EXPECT_CONTAINS(error_of(with_value("/form_factors/indices", 5000)),
                  "row 0 has an entry in column 5000, but there are 29 patches");
  EXPECT_CONTAINS(error_of(with_value("/form_factors/data", nan)), "row 0 has the entry nan");
  EXPECT_CONTAINS(error_of(with_value("/form_factors/error", -1)), "row 0 has the entry -1");
}

TEST_F(FormFactorReader, ExplainsSizesThatDoNotFit) {
  const auto resized = [&](const char* name, hsize_t size) {
    return changed([&](hid_t file) {
      H5Ldelete(file, name, H5P_DEFAULT);
      const hid_t space = H5Screate_simple(1, &size, nullptr);
      const hid_t set =
          H5Dcreate2(file, name, H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      const std::vector<std::int64_t> zeros(size, 0);
      H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data());
      H5Dclose(set);
      H5Sclose(space);
    });
  };
  EXPECT_CONTAINS(error_of(resized("/closure", 3)), "/closure is 3, expected 29");
  EXPECT_CONTAINS(error_of(resized("/form_factors/indptr", 29)), "expected 30");
  EXPECT_CONTAINS(error_of(resized("/form_factors/error", 2)),
                  "/form_factors/error is 2, expected");
  EXPECT_CONTAINS(error_of(resized("/vertices", 9)), "/vertices is 9, expected 9 x 3");
  EXPECT_CONTAINS(error_of(resized("/surfaces/name", 8)), "/surfaces/name is no list of names");
}

/// Cut off anywhere, a file is refused in one line and nothing is printed.
TEST_F(FormFactorReader, RefusesFilesThatWereCutOff) {
  const std::string whole = file_bytes(path_);
  testing::internal::CaptureStderr();
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    write_bytes(folder() / "cut.h5", whole.substr(0, size));
    (void)error_of(folder() / "cut.h5");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// All that a reader tells of a file, as one text.
std::string everything_in(const std::filesystem::path& path) {
  const io::FormFactorReader reader(path);
  std::ostringstream text;
  const auto add = [&](const auto& values) {
    for (const auto& value : values) text << value << ' ';
  };
  for (Index i = 0; i < reader.size(); ++i) text << reader.row(i) << reader.row_error(i);
  for (const auto& vertex : reader.mesh().vertices) text << vertex << ' ';
  for (const auto& corners : reader.mesh().corners) add(corners);
  add(reader.mesh().surface_names);
  add(reader.mesh().surface);
  add(reader.mesh().polygon);
  add(reader.mesh().twin);
  add(reader.mesh().area);
  text << reader.closure() << reader.tolerance() << reader.min_factor() << reader.closed()
       << reader.fingerprint() << reader.warnings().size();
  return text.str();
}

/// With a byte changed, a file is refused in one line, or what changed was of no use: everything in
/// it is as it was. Changes are among the first bytes, where all but entries is, or anywhere.
TEST_F(FormFactorReader, NoticesChangedBytes) {
  const std::string whole = file_bytes(path_);
  const std::string expected = everything_in(path_);
  std::mt19937_64 random(1);
  [[maybe_unused]] const test::LeaksAllowed allowed;
  H5garbage_collect();  // so that HDF5 does not use again, and lose, what it took before
  testing::internal::CaptureStderr();
  int n_refused = 0;
  for (int i = 0; i < 500; ++i) {
    const std::size_t last = i % 4 == 0 ? whole.size() : std::min<std::size_t>(whole.size(), 16384);
    write_bytes(folder() / "flip.h5", test::with_flip(whole, 0, last, random));
    const bool is_refused =
        !test::outcome<SceneError>(folder() / "flip.h5", read_everything).empty();
    n_refused += is_refused ? 1 : 0;
    EXPECT_NE(io::has_intact_form_factors(folder() / "flip.h5"), is_refused) << i;
    if (is_refused) continue;
    EXPECT_EQ(everything_in(folder() / "flip.h5"), expected) << i;
  }
  const std::string printed = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(printed.empty() || kAllocatorPrints) << printed;
  EXPECT_GT(n_refused, 100);
}

/// A copy of a dataset, or of all in a group, as files had them before there were checksums: in one
/// piece, and texts of variable length.
void copy_without_checksums(hid_t from, hid_t to, const std::string& name) {
  const hid_t set = H5Dopen2(from, name.c_str(), H5P_DEFAULT);
  const hid_t type = H5Dget_type(set);
  const hid_t extendable = H5Dget_space(set);
  std::array<hsize_t, 2> lengths{};
  const int rank = H5Sget_simple_extent_dims(extendable, lengths.data(), nullptr);
  const hid_t space = H5Screate_simple(rank, lengths.data(), nullptr);
  H5Sclose(extendable);
  std::vector<char> values(H5Tget_size(type) *
                           static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  std::vector<std::string> texts;
  std::vector<const char*> pointers;
  hid_t stored = H5Tcopy(type);
  const void* source = values.data();
  if (H5Tget_class(type) == H5T_STRING) {
    const std::size_t length = H5Tget_size(type);
    for (std::size_t k = 0; k < values.size(); k += length) {
      texts.push_back(std::string(values.data() + k, length).c_str());
    }
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    source = pointers.data();
    H5Tset_size(stored, H5T_VARIABLE);
  }
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t copy = H5Dcreate2(to, name.c_str(), stored, space, links, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(copy, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, source), 0) << name;
  H5Pclose(links);
  H5Dclose(copy);
  H5Tclose(stored);
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(set);
}

TEST_F(FormFactorReader, ReadsFilesWithoutChecksums) {
  const auto old = folder() / "old.h5";
  const hid_t from = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t to = H5Fcreate(old.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (const char* name : {"patches/area", "patches/centroid", "patches/normal", "patches/surface",
                           "patches/polygon", "patches/corners", "patches/twin", "vertices",
                           "surfaces/name", "surfaces/two_sided", "closure", "form_factors/data",
                           "form_factors/error", "form_factors/indices", "form_factors/indptr"}) {
    copy_without_checksums(from, to, name);
  }
  for (const char* name : {"version", "tolerance", "min_factor", "closed", "fingerprint"}) {
    const hid_t attribute = H5Aopen(from, name, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    const hid_t space = H5Aget_space(attribute);
    std::vector<char> value(H5Tget_size(type));
    H5Aread(attribute, type, value.data());
    const hid_t copy = H5Acreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(copy, type, value.data()), 0);
    H5Aclose(copy);
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(attribute);
  }
  H5Fclose(to);
  H5Fclose(from);
  EXPECT_EQ(everything_in(old), everything_in(path_));
}

}  // namespace
