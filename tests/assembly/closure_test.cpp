#include "radiosity/assembly/closure.h"

#include <gtest/gtest.h>

#include <random>

#include "radiosity/assembly/exchange_matrix.h"

namespace radiosity {
namespace {

constexpr Index kRows = 40;
constexpr double kClosureTolerance = 1e-3;

/// A closed operator with random exchange areas, of which some then get errors.
struct Noisy {
  explicit Noisy(std::uint64_t seed) : random(seed), values(kRows, kRows), sigma(kRows, kRows) {
    std::uniform_real_distribution<double> uniform(0, 1);
    sigma.setZero();
    values.setZero();
    for (Index i = 0; i < kRows; ++i) {
      for (Index j = i + 1; j < kRows; ++j) {
        values(i, j) = values(j, i) = uniform(random) < 0.3 ? 0 : uniform(random);
      }
    }
    areas = values.rowwise().sum();
    std::normal_distribution<double> normal;
    for (Index i = 0; i < kRows; ++i) {
      for (Index j = i + 1; j < kRows; ++j) {
        if (values(i, j) == 0 || uniform(random) < 0.5) continue;
        sigma(i, j) = sigma(j, i) = 1e-3 * values(i, j);
        values(i, j) = values(j, i) = values(i, j) + sigma(i, j) * normal(random);
      }
    }
  }

  /// In tiles of 16 rows.
  [[nodiscard]] ExchangeMatrix tiles() const {
    const Strips strips({0, 16, 32, kRows});
    ExchangeMatrix result(strips);
    for (Index column = 0; column < strips.size(); ++column) {
      for (Index row = 0; row <= column; ++row) {
        ExchangeTile tile;
        tile.row_strip = row;
        tile.column_strip = column;
        tile.values = values.block(strips.begin(row), strips.begin(column), strips.rows(row),
                                   strips.rows(column));
        for (Index r = 0; r < tile.values.rows(); ++r) {
          for (Index c = 0; c < tile.values.cols(); ++c) {
            const double error = sigma(strips.begin(row) + r, strips.begin(column) + c);
            if (error > 0) {
              tile.uncertain.push_back({static_cast<std::uint16_t>(r),
                                        static_cast<std::uint16_t>(c), static_cast<float>(error)});
            }
          }
        }
        result.set(std::move(tile));
      }
    }
    return result;
  }

  std::mt19937_64 random;
  Eigen::MatrixXd values;
  Eigen::MatrixXd sigma;
  Eigen::VectorXd areas;
};

Eigen::MatrixXd matrix(const ExchangeMatrix& tiles) {
  Eigen::MatrixXd result(kRows, kRows);
  for (Index i = 0; i < kRows; ++i) result.row(i) = tiles.row(i);
  return result;
}

TEST(Closure, RowsSumToTheirAreasAndCertainEntriesStay) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Noisy noisy(seed);
    ExchangeMatrix tiles = noisy.tiles();
    const Eigen::VectorXd sums = tiles.row_sums();
    ASSERT_GT((sums - noisy.areas).cwiseAbs().maxCoeff(), 1e-4);
    const ClosedRows rows =
        close_rows(tiles, sums, noisy.areas, Closed::automatic, kClosureTolerance);
    EXPECT_TRUE(rows.is_closed);
    EXPECT_TRUE(rows.open_rows.empty());
    const Eigen::MatrixXd after = matrix(tiles);
    EXPECT_EQ(after, after.transpose());
    EXPECT_GE(after.minCoeff(), 0);
    EXPECT_LE((after.rowwise().sum() - noisy.areas).cwiseAbs().maxCoeff(),
              1e-12 * noisy.areas.maxCoeff());
    for (Index i = 0; i < kRows; ++i) {
      for (Index j = 0; j < kRows; ++j) {
        const double change = std::abs(after(i, j) - noisy.values(i, j));
        if (noisy.sigma(i, j) == 0) {
          EXPECT_EQ(change, 0) << i << ", " << j;
        } else {
          EXPECT_LE(change, 6 * noisy.sigma(i, j)) << i << ", " << j;
          EXPECT_GT(tiles.entry(i, j).error, 0) << "the error stays what it is";
        }
      }
    }
  }
}

TEST(Closure, WhatIsNotClosedStaysAsItIs) {
  const Noisy noisy(1);
  const Eigen::VectorXd larger = 1.1 * noisy.areas;
  for (const Closed asked : {Closed::automatic, Closed::no}) {
    ExchangeMatrix tiles = noisy.tiles();
    const Eigen::VectorXd sums = tiles.row_sums();
    const ClosedRows rows = close_rows(tiles, sums, larger, asked, kClosureTolerance);
    EXPECT_FALSE(rows.is_closed);
    EXPECT_EQ(matrix(tiles), noisy.values);
    EXPECT_EQ(rows.sums.present, sums);
    EXPECT_EQ(rows.sums.wanted, sums);
  }
}

// No patch has more around it than all directions, whether the scene is closed or not.
TEST(Closure, RowsOfOpenScenesHaveNoMoreThanTheirAreas) {
  int n_over = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Noisy noisy(seed);
    ExchangeMatrix tiles = noisy.tiles();
    const Eigen::VectorXd sums = tiles.row_sums();
    Eigen::VectorXd areas = noisy.areas;
    for (Index i = 0; i < kRows; i += 2) areas[i] *= 1.1;
    const double tolerance = 1e-5;
    const ClosedRows rows = close_rows(tiles, sums, areas, Closed::automatic, tolerance);
    EXPECT_FALSE(rows.is_closed);
    EXPECT_EQ(rows.sums.wanted, rows.sums.present);
    const Eigen::MatrixXd after = matrix(tiles);
    EXPECT_EQ(after, after.transpose());
    EXPECT_GE(after.minCoeff(), 0);
    const Eigen::ArrayXd excess = sums.array() - areas.array();
    const double rounding = 1e-12 * areas.maxCoeff();
    for (Index i = 0; i < kRows; ++i) {
      EXPECT_NEAR(after.row(i).sum(), rows.sums.present[i], rounding) << i;
      EXPECT_LE(after.row(i).sum(), sums[i] + rounding) << i;
      if (excess[i] > tolerance * areas[i]) {
        ++n_over;
        EXPECT_LE(after.row(i).sum(), areas[i] + rounding) << i;
      }
      for (Index j = 0; j < kRows; ++j) {
        const double change = noisy.values(i, j) - after(i, j);
        EXPECT_GE(change, 0) << i << ", " << j;
        const bool may_change = noisy.sigma(i, j) > 0 && std::max(excess[i], excess[j]) > 0;
        EXPECT_LE(change, may_change ? 3 * noisy.sigma(i, j) : 0) << i << ", " << j;
      }
    }
  }
  EXPECT_GT(n_over, 50);
}

TEST(Closure, AnExcessThatNoErrorExplainsStays) {
  const Noisy noisy(3);
  Eigen::VectorXd areas = 1.1 * noisy.areas;
  areas[5] *= 0.7;
  ExchangeMatrix tiles = noisy.tiles();
  const Eigen::VectorXd sums = tiles.row_sums();
  EXPECT_EQ(close_rows(tiles, sums, areas, Closed::no, kClosureTolerance).sums.present, sums);
  EXPECT_EQ(matrix(tiles), noisy.values);
}

TEST(Closure, AHoleIsCountedAndNotMended) {
  const Noisy noisy(2);
  Eigen::VectorXd areas = noisy.areas;
  areas[7] *= 1.2;  // a fifth of what leaves it is lost
  ExchangeMatrix tiles = noisy.tiles();
  const Eigen::VectorXd sums = tiles.row_sums();
  EXPECT_FALSE(is_closed_within_errors(tiles, sums, areas, kClosureTolerance));
  const ClosedRows rows = close_rows(tiles, sums, areas, Closed::yes, kClosureTolerance);
  EXPECT_TRUE(rows.is_closed);
  EXPECT_EQ(rows.open_rows, std::vector<Index>{7});
  EXPECT_EQ(rows.sums.mask[7], 0);
  const Eigen::MatrixXd after = matrix(tiles);
  EXPECT_EQ(after.row(7), noisy.values.row(7));
  for (Index i = 0; i < kRows; ++i) {
    if (i == 7) continue;
    EXPECT_NEAR(after.row(i).sum(), areas[i], 1e-12 * areas.maxCoeff()) << i;
  }
}

TEST(Closure, AnEntryEndsAtZero) {
  double value = 1;
  EXPECT_TRUE(change_entry(value, 0.5, 2));
  EXPECT_DOUBLE_EQ(value, 1.5);
  EXPECT_FALSE(change_entry(value, 1, -3));
  EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace radiosity
