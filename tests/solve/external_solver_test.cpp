#include "radiosity/solve/external_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <atomic>
#include <limits>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/solve/led_solver.h"
#include "radiosity/solve/solve.h"
#include "tests/support/direct_solve.h"
#include "tests/support/matrix_transport.h"
#include "tests/support/messages.h"
#include "tests/support/thread_ranks.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::random_matrix;

constexpr std::uint64_t kExternalSeed = 20261130;

Eigen::MatrixXd entries(Index n, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& a) {
  Eigen::MatrixXd matrix(n, n);
  for (Index j = 0; j < n; ++j) matrix.col(j) = a(Eigen::VectorXd::Unit(n, j));
  return matrix;
}

/// By LU of all entries, which n products tell.
LinearSolution solve_by_entries(const LinearSystem& system) {
  const Eigen::MatrixXd a = entries(system.right_side.size(), system.apply);
  return {a.partialPivLu().solve(system.right_side), 1};
}

/// Conjugate gradients on Aᵀ A x = Aᵀ b, no further than to what is asked.
LinearSolution solve_normally(const LinearSystem& system) {
  const double asked = system.tolerance * system.right_side.norm();
  LinearSolution solution{Eigen::VectorXd::Zero(system.right_side.size()), 0};
  Eigen::VectorXd residual = system.right_side;
  Eigen::VectorXd gradient = system.apply_transposed(residual);
  Eigen::VectorXd direction = gradient;
  while (residual.norm() > asked && solution.iterations < system.max_products) {
    const Eigen::VectorXd image = system.apply(direction);
    const double squared = gradient.squaredNorm();
    const double step = squared / image.squaredNorm();
    solution.unknowns += step * direction;
    residual -= step * image;
    gradient = system.apply_transposed(residual);
    direction = gradient + gradient.squaredNorm() / squared * direction;
    ++solution.iterations;
  }
  return solution;
}

SolveOptions solved_by(LinearSolver solver, double tolerance) {
  SolveOptions options;
  options.method = Method::external;
  options.solver = std::move(solver);
  options.tolerance = tolerance;
  return options;
}

/// Patches of which some reflect nothing, in three bands of which one is unlit.
struct LitPatches {
  DenseTestTransport transport;
  Eigen::MatrixXd exitance;
  Eigen::MatrixXd reflectance;
};

LitPatches random_lit_patches(Index n, bool is_closed, std::mt19937_64& random) {
  LitPatches lit{is_closed ? test::random_closed(n, random) : test::random_open(n, random),
                 random_matrix(n, 3, -5, 1, random).cwiseMax(0),
                 random_matrix(n, 3, -0.2, 0.95, random).cwiseMax(0)};
  lit.exitance.col(1).setZero();
  return lit;
}

TEST(ExternalSolver, AgreesWithDenseLuWithinItsBound) {
  std::mt19937_64 random(kExternalSeed);
  for (int trial = 0; trial < 10; ++trial) {
    const LitPatches lit = random_lit_patches(20 + trial, trial % 2 == 0, random);
    const Eigen::MatrixXd expected =
        test::solve_directly(lit.transport.form_factors(), lit.exitance, lit.reflectance);
    for (const LinearSolver& solver :
         {LinearSolver(solve_by_entries), LinearSolver(solve_normally)}) {
      for (const double tolerance : {1e-2, 1e-9}) {
        const Solution solution =
            solve(lit.transport, lit.exitance, lit.reflectance, solved_by(solver, tolerance));
        EXPECT_TRUE(solution.converged) << trial;
        EXPECT_EQ(solution.method, Method::external);
        EXPECT_LE(solution.error_bound, tolerance);
        EXPECT_LE(test::relative_error(lit.transport.area(), solution.radiosity, expected),
                  solution.error_bound + 1e-12)
            << trial;
        EXPECT_TRUE(solution.radiosity.col(1).isZero(0)) << "unlit";
      }
    }
  }
}

TEST(ExternalSolver, SystemIsWhatItSays) {
  std::mt19937_64 random(kExternalSeed);
  for (const bool has_sheet : {false, true}) {
    const LitPatches lit = random_lit_patches(12, true, random);
    SolveOptions options = solved_by({}, 1e-6);
    Eigen::MatrixXd reflectance = lit.reflectance;
    const DenseTestTransport& transport = lit.transport;
    if (has_sheet) {
      // A_0 T_01 = A_1 T_10.
      const Eigen::VectorXd& area = transport.area();
      const double passed = 0.3 * std::min(area[0], area[1]);
      reflectance.topRows(2).setConstant(0.5);
      options.transmission.resize(12, 12);
      options.transmission.insert(0, 1) = passed / area[0];
      options.transmission.insert(1, 0) = passed / area[1];
    }
    int n_systems = 0;
    options.solver = [&](const LinearSystem& system) {
      ++n_systems;
      EXPECT_EQ(system.is_symmetric, !has_sheet);
      const Eigen::MatrixXd a = entries(12, system.apply);
      const Eigen::MatrixXd transposed = entries(12, system.apply_transposed);
      EXPECT_LE((a.transpose() - transposed).norm(), 1e-14);
      EXPECT_TRUE(has_sheet || (a - transposed).norm() <= 1e-14);
      return solve_by_entries(system);
    };
    const Solution solution = solve(transport, lit.exitance, reflectance, options);
    EXPECT_EQ(n_systems, 2) << "of three columns one is unlit";
    EXPECT_TRUE(solution.converged);
    EXPECT_LE(solution.residual, 1e-13);
  }
}

TEST(ExternalSolver, GoesOnFromAStart) {
  std::mt19937_64 random(kExternalSeed);
  const LitPatches lit = random_lit_patches(25, false, random);
  const Solution known =
      solve(lit.transport, lit.exitance, lit.reflectance, solved_by(solve_normally, 1e-6));
  SolveOptions options = solved_by(solve_normally, 1e-9);
  const Solution anew = solve(lit.transport, lit.exitance, lit.reflectance, options);
  options.start = known.irradiance;
  const Solution warm = solve(lit.transport, lit.exitance, lit.reflectance, options);
  EXPECT_TRUE(warm.converged);
  EXPECT_LT(warm.iterations, anew.iterations);
}

TEST(ExternalSolver, TellsWhatIsNotSolved) {
  std::mt19937_64 random(kExternalSeed);
  const LitPatches lit = random_lit_patches(25, true, random);
  const Eigen::MatrixXd expected =
      test::solve_directly(lit.transport.form_factors(), lit.exitance, lit.reflectance);
  for (const double value : {0., 1e3, std::numeric_limits<double>::quiet_NaN()}) {
    const auto wrong = [value](const LinearSystem& system) -> LinearSolution {
      return {Eigen::VectorXd::Constant(system.right_side.size(), value), 7};
    };
    const Solution solution =
        solve(lit.transport, lit.exitance, lit.reflectance, solved_by(wrong, 1e-6));
    EXPECT_FALSE(solution.converged) << value;
    EXPECT_TRUE(solution.radiosity.allFinite()) << value;
    EXPECT_LE(test::relative_error(lit.transport.area(), solution.radiosity, expected),
              solution.error_bound)
        << value;
  }
  try {
    (void)solve(lit.transport, lit.exitance, lit.reflectance, solved_by({}, 1e-6));
    ADD_FAILURE() << "solved without a solver";
  } catch (const SolveError& error) {
    test::expect_contains(error.what(), "SolveOptions::solver");
  }
}

TEST(LedSolver, GivesAllRanksTheSame) {
  std::mt19937_64 random(kExternalSeed);
  const LitPatches lit = random_lit_patches(30, true, random);
  const Solution alone =
      solve(lit.transport, lit.exitance, lit.reflectance, solved_by(solve_normally, 1e-8));
  for (const int size : {1, 2, 3}) {
    std::atomic<int> n_runs = 0;
    test::on_ranks(size, [&](Ranks& ranks) {
      const LinearSolver counted = [&](const LinearSystem& system) {
        ++n_runs;
        return solve_normally(system);
      };
      const Solution solution = solve(lit.transport, lit.exitance, lit.reflectance,
                                      solved_by(led_by_first_rank(ranks, counted), 1e-8));
      EXPECT_EQ(solution.radiosity, alone.radiosity) << "rank " << ranks.rank();
      EXPECT_EQ(solution.iterations, alone.iterations);
      EXPECT_EQ(solution.products, alone.products);
    });
    EXPECT_EQ(n_runs, 2) << "on the first rank only";
  }
}

TEST(LedSolver, FailsOnAllRanks) {
  std::mt19937_64 random(kExternalSeed);
  const LitPatches lit = random_lit_patches(10, true, random);
  std::atomic<int> n_others = 0;
  const auto fails = [&](Ranks& ranks) {
    const LinearSolver solver = led_by_first_rank(ranks, [](const LinearSystem& system) {
      (void)system.apply(system.right_side);
      throw SolveError("broke down");
      return LinearSolution();
    });
    try {
      (void)solve(lit.transport, lit.exitance, lit.reflectance, solved_by(solver, 1e-8));
    } catch (const FirstRankFailed&) {
      ++n_others;
    }
  };
  EXPECT_THROW(test::on_ranks(3, fails), SolveError);
  EXPECT_EQ(n_others, 2);
}

}  // namespace
}  // namespace radiosity
