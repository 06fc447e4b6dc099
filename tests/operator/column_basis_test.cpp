#include "radiosity/operator/column_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::random_closed;
using test::random_matrix;

TEST(ColumnBasis, KeepsItsTolerances) {
  std::mt19937_64 random(11);
  const DenseTestTransport transport = random_closed(60, random);
  // Forty columns near a space of five, each a little off it and of its own size.
  Eigen::MatrixXd x = random_matrix(60, 5, -1, 1, random) * random_matrix(5, 40, -1, 1, random) +
                      1e-6 * random_matrix(60, 40, -1, 1, random);
  for (Index c = 0; c < x.cols(); ++c) x.col(c) *= std::pow(10.0, static_cast<double>(c % 7));
  const Eigen::MatrixXd exact = transport.apply(x);
  for (const double relative : {1e-14, 1e-9, 1e-4, 0.3}) {
    const Eigen::VectorXd tolerance = relative * energy_norms(transport, x);
    const long before = transport.n_columns();
    const Eigen::MatrixXd product = apply_by_basis(transport, x, tolerance);
    const long used = transport.n_columns() - before;
    const Eigen::VectorXd errors = energy_norms(transport, product - exact);
    for (Index c = 0; c < x.cols(); ++c) {
      EXPECT_LE(errors[c], tolerance[c] + 1e-14 * exact.col(c).norm()) << relative;
    }
    EXPECT_LE(used, 40);
    if (relative >= 1e-4) {
      EXPECT_LE(used, 5);
    }
  }
}

TEST(ColumnBasis, TakesZerosAndFewColumns) {
  std::mt19937_64 random(12);
  const DenseTestTransport transport = random_closed(20, random);
  const Eigen::MatrixXd zeros = Eigen::MatrixXd::Zero(20, 12);
  EXPECT_TRUE(apply_by_basis(transport, zeros, Eigen::VectorXd::Zero(12)).isZero(0));
  const Eigen::MatrixXd few = random_matrix(20, 3, 0, 1, random);
  EXPECT_EQ(apply_by_basis(transport, few, Eigen::VectorXd::Ones(3)), transport.apply(few));
}

/// Seventy bands of three materials, solved at once and one by one.
TEST(Solve, ManyBandsAtOnceAreTheBandsOneByOne) {
  std::mt19937_64 random(13);
  const DenseTestTransport transport = random_closed(90, random);
  const Index n_bands = 70;
  Eigen::MatrixXd spectra(3, n_bands);
  Eigen::VectorXd lamp(n_bands);
  for (Index b = 0; b < n_bands; ++b) {
    const double t = static_cast<double>(b) / static_cast<double>(n_bands);
    spectra.col(b) << 0.7 + 0.1 * std::sin(6 * t), 0.1 + 0.6 * t * t, 0.5 * (1 - t);
    lamp[b] = 10 * t;  // dark in the first band
  }
  Eigen::MatrixXd reflectance(90, n_bands);
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(90, n_bands);
  for (Index i = 0; i < 90; ++i) reflectance.row(i) = spectra.row(i % 3);
  exitance.topRows(4).rowwise() = lamp.transpose();
  const SolveOptions options{.tolerance = 1e-11};
  const long before = transport.n_columns();
  const Solution all = solve(transport, exitance, reflectance, options);
  const double columns = static_cast<double>(transport.n_columns() - before);
  EXPECT_TRUE(all.converged);
  // Less than the columns of as many products of all bands.
  EXPECT_LT(columns, 0.9 * static_cast<double>(n_bands) * all.products);
  for (const Index b : {0, 1, 17, 40, 69}) {
    const Solution one = solve(transport, exitance.col(b), reflectance.col(b), options);
    EXPECT_LE((all.radiosity.col(b) - one.radiosity.col(0)).norm(), 1e-10 * one.radiosity.norm());
  }
}

}  // namespace
}  // namespace radiosity
