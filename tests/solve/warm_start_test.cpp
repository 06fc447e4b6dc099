#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "tests/support/direct_solve.h"
#include "tests/support/every_method.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::random_matrix;
using test::relative_error;
using test::solve_directly;

constexpr std::uint64_t kWarmSeed = 20250311;
constexpr Index kWarmPatches = 40;

class WarmStart : public ::testing::TestWithParam<Method> {
 protected:
  [[nodiscard]] Solution solve_from(const Eigen::MatrixXd& start, double tolerance = 1e-8) const {
    return solve(transport_, exitance_, reflectance_,
                 {.method = GetParam(), .tolerance = tolerance, .start = start, .on_step = {}});
  }
  [[nodiscard]] Eigen::MatrixXd expected() const {
    return solve_directly(transport_.form_factors(), exitance_, reflectance_);
  }

  std::mt19937_64 random_{kWarmSeed};
  DenseTestTransport transport_ = test::chamber_ring(5, kWarmPatches / 5, 0.1, random_);
  Eigen::MatrixXd exitance_ = random_matrix(kWarmPatches, 3, -3, 1, random_).cwiseMax(0);
  Eigen::MatrixXd reflectance_ = random_matrix(kWarmPatches, 3, -0.2, 0.9, random_).cwiseMax(0);
};

INSTANTIATE_TEST_SUITE_P(Solve, WarmStart, ::testing::ValuesIn(test::kMethods),
                         test::method_test_name);

TEST_P(WarmStart, LeadsToTheSolutionWithinItsBound) {
  const Eigen::MatrixXd b = expected();
  for (const double tolerance : {1e-1, 1e-4, 1e-8}) {
    for (const double low : {0., -3.}) {  // irradiance cannot be negative, but a start may
      const Solution solution =
          solve_from(random_matrix(kWarmPatches, 3, low, 3, random_), tolerance);
      SCOPED_TRACE("tolerance " + std::to_string(tolerance) + ", from " + std::to_string(low));
      EXPECT_TRUE(solution.converged);
      EXPECT_LE(solution.error_bound, tolerance);
      EXPECT_LE(relative_error(transport_.area(), solution.radiosity, b), solution.error_bound);
      const Eigen::MatrixXd gathered = transport_.form_factors() * solution.radiosity;
      EXPECT_LE((solution.irradiance - gathered).norm(), 1e-13 * gathered.norm());
    }
  }
}

TEST_P(WarmStart, AtTheSolutionThereIsNothingToDo) {
  const Solution solution = solve_from({}, 1e-10);
  ASSERT_TRUE(solution.converged);
  const Solution again = solve_from(solution.irradiance);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(again.products, 1);
  EXPECT_LE(relative_error(transport_.area(), again.radiosity, solution.radiosity), 1e-8);
}

TEST_P(WarmStart, SavesProductsAfterASmallChange) {
  const Solution before = solve_from({});
  reflectance_.topRows(kWarmPatches / 5) *= 0.99;
  const Solution warm = solve_from(before.irradiance, 1e-4);
  const Solution cold = solve_from({}, 1e-4);
  EXPECT_TRUE(warm.converged);
  EXPECT_LT(warm.products, cold.products);
}

TEST_P(WarmStart, StoppedEarlyStillTellsAValidBound) {
  const Eigen::MatrixXd b = expected();
  const Eigen::MatrixXd start = random_matrix(kWarmPatches, 3, 0, 3, random_);
  for (int products = 1; products < 8; ++products) {
    const Solution solution =
        solve(transport_, exitance_, reflectance_,
              {.method = GetParam(), .max_products = products, .start = start, .on_step = {}});
    EXPECT_FALSE(solution.converged);
    EXPECT_LE(solution.products, products);
    EXPECT_LE(relative_error(transport_.area(), solution.radiosity, b), solution.error_bound);
  }
}

TEST_P(WarmStart, LeavesUnlitColumnsExactlyDark) {
  exitance_.col(1).setZero();
  const Solution solution = solve_from(Eigen::MatrixXd::Ones(kWarmPatches, 3));
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(solution.radiosity.col(1).norm(), 0);
  exitance_.setZero();
  EXPECT_EQ(solve_from(Eigen::MatrixXd::Ones(kWarmPatches, 3)).radiosity.norm(), 0);
}

TEST_P(WarmStart, OfBlackPatchesIsForgotten) {
  reflectance_.setZero();
  const Solution solution = solve_from(Eigen::MatrixXd::Ones(kWarmPatches, 3));
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(solution.radiosity, exitance_);
  EXPECT_LE((solution.irradiance - transport_.form_factors() * exitance_).norm(), 1e-13);
}

TEST_P(WarmStart, HasToFit) {
  const auto message = [&](const Eigen::MatrixXd& start) {
    try {
      (void)solve_from(start);
    } catch (const SolveError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message(Eigen::MatrixXd(0, 3)), "accepted");  // empty: darkness
  EXPECT_EQ(message(Eigen::MatrixXd::Ones(40, 2)),
            "start is 40 x 2 and exitance 40 x 3; expected the same shape, or no start");
  EXPECT_EQ(message(Eigen::MatrixXd::Ones(39, 3)),
            "start is 39 x 3 and exitance 40 x 3; expected the same shape, or no start");
  Eigen::MatrixXd start = Eigen::MatrixXd::Ones(40, 3);
  start(7, 1) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message(start), "start has a value that is not finite; expected irradiance, W/m²");
}

}  // namespace
}  // namespace radiosity
