#include "radiosity/compressed/block_product.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>
#include <vector>

namespace radiosity {
namespace {

template <int kColumns>
void check_products(int n_rows, int n_columns, std::mt19937& random) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kColumns,
                             kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  using Numbers = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto value = [&] { return uniform(random); };
  const Eigen::MatrixXd numbers = Eigen::MatrixXd::NullaryExpr(n_rows, n_columns, value);
  const Numbers m = numbers.cast<float>();
  const Eigen::MatrixXd exact = m.cast<double>();
  const Rows of_columns = Rows::NullaryExpr(n_columns, kColumns, value);
  const Rows of_rows = Rows::NullaryExpr(n_rows, kColumns, value);
  const SmallMatrix small{m.data(), n_rows, n_columns};

  Rows y = of_rows;
  add_product<kColumns>(small, of_columns.data(), y.data());
  const Rows expected = of_rows + exact * of_columns;
  EXPECT_LE((y - expected).cwiseAbs().maxCoeff(), 1e-13) << n_rows << " x " << n_columns;

  Rows z = of_columns;
  add_transposed_product<kColumns>(small, of_rows.data(), z.data());
  const Rows other = of_columns + exact.transpose() * of_rows;
  EXPECT_LE((z - other).cwiseAbs().maxCoeff(), 1e-13) << n_rows << " x " << n_columns;
}

/// Rows whose ends lie on stairs, as those of blocks of a largest degree.
template <int kColumns>
void check_stairs(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> length(0, 11);
  const auto value = [&] { return uniform(random); };
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kColumns,
                             kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  StairMatrix stairs{nullptr, 1 + length(random) % StairMatrix::kMostSteps, {}};
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(60, 12);
  std::vector<float> numbers;
  int n_rows = 0;
  for (int k = 0; k < stairs.n_steps; ++k) {
    stairs.steps[k] = {length(random), length(random)};
    for (int end = n_rows + stairs.steps[k].n_rows; n_rows < end; ++n_rows) {
      for (int c = 0; c < stairs.steps[k].n_columns; ++c) {
        numbers.push_back(static_cast<float>(value()));
        whole(n_rows, c) = numbers.back();
      }
    }
  }
  stairs.numbers = numbers.data();
  const Rows of_columns = Rows::NullaryExpr(12, kColumns, value);
  const Rows of_rows = Rows::NullaryExpr(60, kColumns, value);

  Rows y = of_rows;
  add_product<kColumns>(stairs, of_columns.data(), y.data());
  EXPECT_LE((y - of_rows - whole * of_columns).cwiseAbs().maxCoeff(), 1e-13);
  Rows z = of_columns;
  add_transposed_product<kColumns>(stairs, of_rows.data(), z.data());
  EXPECT_LE((z - of_columns - whole.transpose() * of_rows).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(BlockProduct, OfStairsIsThatOfAMatrixWithZerosBeyond) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    check_stairs<1>(random);
    check_stairs<kFewColumns>(random);
    check_stairs<kManyColumns>(random);
  }
}

TEST(BlockProduct, IsThatOfTheWholeMatrix) {
  std::mt19937 random(1);
  for (int n_rows = 1; n_rows <= 9; ++n_rows) {
    for (int n_columns = 1; n_columns <= 9; ++n_columns) {
      check_products<1>(n_rows, n_columns, random);
      check_products<kFewColumns>(n_rows, n_columns, random);
      check_products<kManyColumns>(n_rows, n_columns, random);
    }
  }
}

}  // namespace
}  // namespace radiosity
