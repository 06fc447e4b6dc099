#include "io/result/form_factor_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <string>
#include <vector>

#include "io/result/surface_csv.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/output_folder.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;

template <typename T>
std::vector<T> read_dataset(hid_t file, const char* name, hid_t type) {
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  EXPECT_GE(set, 0) << name;
  const hid_t space = H5Dget_space(set);
  std::vector<T> values(H5Sget_simple_extent_npoints(space));
  EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space);
  H5Dclose(set);
  return values;
}

using FormFactorFile = OutputFolder;

struct Case {
  PatchMesh mesh;
  std::unique_ptr<Visibility> visibility;
  std::unique_ptr<Transport> transport;
};

Case box_in_box() {
  Case result;
  result.mesh = test::box_in_box(3, 2);
  result.visibility = std::make_unique<Visibility>(result.mesh);
  result.transport = make_transport(result.mesh, *result.visibility);
  return result;
}

TEST_F(FormFactorFile, HoldsRowsErrorsAndPatches) {
  const Case box = box_in_box();
  const auto path = folder() / "f.h5";
  io::write_form_factors(path, box.mesh, *box.transport, {.tolerance = 1e-3});

  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const auto data = read_dataset<double>(file, "/form_factors/data", H5T_NATIVE_DOUBLE);
  const auto error = read_dataset<double>(file, "/form_factors/error", H5T_NATIVE_DOUBLE);
  const auto columns = read_dataset<std::int64_t>(file, "/form_factors/indices", H5T_NATIVE_INT64);
  const auto starts = read_dataset<std::int64_t>(file, "/form_factors/indptr", H5T_NATIVE_INT64);
  const Index n = box.mesh.size();
  ASSERT_EQ(static_cast<Index>(starts.size()), n + 1);
  ASSERT_EQ(starts.back(), static_cast<std::int64_t>(data.size()));
  ASSERT_EQ(data.size(), error.size());
  ASSERT_EQ(data.size(), columns.size());
  for (Index i = 0; i < n; ++i) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd row_error = Eigen::VectorXd::Zero(n);
    for (std::int64_t k = starts[i]; k < starts[i + 1]; ++k) {
      row[columns[k]] = data[k];
      row_error[columns[k]] = error[k];
    }
    EXPECT_EQ(row, rows_of(*box.transport).row(i));
    EXPECT_EQ(row_error, rows_of(*box.transport).row_error(i));
  }
  EXPECT_EQ(read_dataset<double>(file, "/patches/area", H5T_NATIVE_DOUBLE), box.mesh.area);
  EXPECT_EQ(read_dataset<int>(file, "/patches/surface", H5T_NATIVE_INT), box.mesh.surface);
  EXPECT_EQ(read_dataset<int>(file, "/patches/polygon", H5T_NATIVE_INT), box.mesh.polygon);
  EXPECT_EQ(read_dataset<double>(file, "/patches/normal", H5T_NATIVE_DOUBLE).size(),
            static_cast<std::size_t>(3 * n));
  const auto closure = read_dataset<double>(file, "/closure", H5T_NATIVE_DOUBLE);
  for (Index i = 0; i < n; ++i) EXPECT_EQ(closure[i], box.transport->report().row_sums[i]);
  for (const char* name : {"tolerance", "closed", "version"}) {
    EXPECT_GT(H5Aexists(file, name), 0) << name;
  }
  EXPECT_GE(H5Fclose(file), 0);
}

TEST_F(FormFactorFile, MissingFolderIsAnError) {
  const Case box = box_in_box();
  EXPECT_THROW(io::write_form_factors("/no/such/folder/f.h5", box.mesh, *box.transport),
               OutputError);
}

TEST(SurfaceFormFactors, AreReciprocalAndClosed) {
  const Case box = box_in_box();
  const Eigen::MatrixXd factors = surface_form_factors(box.mesh, *box.transport);
  const Eigen::MatrixXd exchange = surface_areas(box.mesh).asDiagonal() * factors;
  EXPECT_LT((exchange - exchange.transpose()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((factors.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-10);
  // A flat surface does not see itself.
  EXPECT_EQ(factors.diagonal().cwiseAbs().maxCoeff(), 0);
}

}  // namespace
