#include "radiosity/compressed/row_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/visibility/coverage.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

TEST(RowCheck, TellsWhatAllRowsAreOffByInTheMeanAndAsALimit) {
  // A screen close to the floor: the few rows below it are off by far more than the others.
  PatchMesh mesh;
  test::add_box(mesh, Vec3::Zero(), Vec3::Ones(), 10, test::Facing::inwards);
  test::add_box(mesh, Vec3(0.3, 0.2, 0.05), Vec3(0.7, 0.8, 0.08), 4, test::Facing::outwards);
  const Visibility visibility(mesh);
  const auto dense =
      make_dense_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no});
  const auto compressed =
      make_compressed_transport(mesh, visibility, {.tolerance = 5e-2, .closed = Closed::no});
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(mesh.size(), 1);
  const Eigen::MatrixXd gathered = compressed->apply(ones);
  const Eigen::VectorXd off = gathered - dense->apply(ones);
  const Eigen::VectorXd& area = dense->area();
  const double mean_square = area.dot(off.cwiseAbs2()) / area.dot(gathered.col(0).cwiseAbs2());
  EXPECT_GT(std::sqrt(mean_square), 1e-3);

  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  const ExchangeEvaluator evaluator(mesh, visibility, coverage, {.tolerance = 1e-3});
  const Eigen::MatrixXd told = compressed->order().to_patches(
      compressed->matrix().common_errors(compressed->order().to_rows(area)));
  constexpr int kTrials = 20;
  double sum = 0;
  int n_within = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RowCheck check(evaluator, mesh.area, told.col(0), ones, trial + 1);
    check.add_rows(96, {});
    const RowCheck::Error error = check.error(gathered);
    EXPECT_EQ(error.n_rows, 96);
    sum += error.estimate * error.estimate / kTrials;
    n_within += std::sqrt(mean_square) <= error.limit ? 1 : 0;
  }
  EXPECT_NEAR(sum / mean_square, 1, 0.2);
  // Of a limit of 95 % fewer than 17 of 20 happen once in 60 times.
  EXPECT_GE(n_within, 17);
}

}  // namespace
}  // namespace radiosity
