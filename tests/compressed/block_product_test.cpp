#include "radiosity/compressed/block_product.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

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
