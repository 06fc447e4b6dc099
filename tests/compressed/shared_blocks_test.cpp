// Compressed operators that several ranks make and multiply with together, against those of one:
// the same bits. Ranks are threads here.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/error.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/output_folder.h"
#include "tests/support/shapes.h"
#include "tests/support/thread_ranks.h"

namespace radiosity {
namespace {

/// A room with a box in it, or one of its corners, turned.
PatchMesh turned_room(int n, bool is_open) {
  PatchMesh mesh;
  if (is_open) {
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 2 * n, n);
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), 2 * n, 2 * n);
    test::add_box(mesh, Vec3(0.35, 0.3, 0.25), Vec3(0.65, 0.6, 0.75), n, test::Facing::outwards);
  } else {
    mesh = test::box_in_box(n, n / 2);
  }
  const Eigen::AngleAxisd turn(0.7, Vec3(1, -1, 3).normalized());
  for (Vec3& vertex : mesh.vertices) vertex = turn * vertex;
  for (Vec3& centroid : mesh.centroid) centroid = turn * centroid;
  for (Vec3& normal : mesh.normal) normal = turn * normal;
  return mesh;
}

class SharedBlocks : public OutputFolder {
 protected:
  struct Found {
    AssemblyReport report;
    Eigen::MatrixXd applied, apply_error, size_error;
    Solution solution;
  };

  [[nodiscard]] Found find(const PatchMesh& mesh, Ranks* ranks, WorkStart start) const {
    const Index n = mesh.size();
    ExpectedLight light{Eigen::MatrixXd::Zero(n, 2), Eigen::MatrixXd::Constant(n, 1, 0.6), {}};
    light.exitance.topRows(n / 10).setConstant(2);
    const Visibility visibility(mesh);
    const auto transport = make_compressed_transport(
        mesh, visibility,
        {.tolerance = 3e-2, .ranks = ranks, .work_file = folder() / "blocks", .work_start = start},
        light);
    Eigen::MatrixXd fields(n, 10);
    for (Index i = 0; i < n; ++i) {
      for (Index c = 0; c < 10; ++c) fields(i, c) = 1 + std::sin(static_cast<double>(i * (c + 1)));
    }
    Found found;
    found.report = transport->report();
    found.applied = transport->apply(fields);
    found.apply_error = transport->apply_error(fields.leftCols(2));
    found.solution = solve(*transport, light.exitance, light.reflectance, {.tolerance = 1e-6});
    found.size_error = discretisation_error(mesh, *transport, found.solution).error;
    return found;
  }

  void expect_same(const PatchMesh& mesh, int n_ranks, WorkStart start) const {
    SCOPED_TRACE(std::to_string(n_ranks) + " ranks, " + std::to_string(mesh.size()) + " patches");
    const Found alone = find(mesh, nullptr, WorkStart::anew);
    std::vector<Found> found(n_ranks);
    test::on_ranks(n_ranks, [&](Ranks& ranks) { found[ranks.rank()] = find(mesh, &ranks, start); });
    for (const Found& one : found) {
      EXPECT_EQ(one.applied, alone.applied);
      EXPECT_EQ(one.apply_error, alone.apply_error);
      EXPECT_EQ(one.size_error, alone.size_error);
      EXPECT_EQ(one.solution.radiosity, alone.solution.radiosity);
      EXPECT_EQ(one.solution.radiosity_error, alone.solution.radiosity_error);
      EXPECT_EQ(one.report.facing, alone.report.facing);
      EXPECT_EQ(one.report.closed, alone.report.closed);
      EXPECT_EQ(one.report.row_sums, alone.report.row_sums);
      EXPECT_EQ(one.report.compression->verified_error, alone.report.compression->verified_error);
      EXPECT_EQ(one.report.compression->entries, alone.report.compression->entries);
    }
  }
};

TEST_F(SharedBlocks, GiveTheSameBitsInAClosedRoom) {
  expect_same(turned_room(10, false), 3, WorkStart::anew);
}

TEST_F(SharedBlocks, GiveTheSameBitsInTheOpen) {
  expect_same(turned_room(9, true), 2, WorkStart::anew);
}

TEST_F(SharedBlocks, GoOnWithWhatOneProcessHasMade) {
  const PatchMesh mesh = turned_room(8, false);
  expect_same(mesh, 5, WorkStart::resumed);
  const Found alone = find(mesh, nullptr, WorkStart::anew);
  std::filesystem::resize_file(folder() / "blocks",
                               std::filesystem::file_size(folder() / "blocks") / 2);
  test::on_ranks(2, [&](Ranks& ranks) {
    EXPECT_EQ(find(mesh, &ranks, WorkStart::resumed).applied, alone.applied);
  });
}

}  // namespace
}  // namespace radiosity
