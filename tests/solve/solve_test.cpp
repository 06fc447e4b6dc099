#include "radiosity/solve/solve.h"
#include "radiosity/solve/solution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "tests/support/direct_solve.h"
#include "tests/support/every_method.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::energy_norm;
using test::random_matrix;
using test::relative_error;
using test::solve_directly;
using test::with_method;

constexpr std::uint64_t kSolveSeed = 20240607;

nlohmann::json known_case(const std::string& name_part) {
  std::ifstream file(RADIOSITY_TEST_DATA "/form-factors.json");
  const nlohmann::json known = nlohmann::json::parse(file);
  for (const auto& entry : known.at("cases")) {
    if (entry.at("name").get<std::string>().find(name_part) != std::string::npos) return entry;
  }
  throw std::runtime_error("no case called " + name_part);
}

double number(const nlohmann::json& text) { return std::stod(text.get<std::string>()); }

class EveryMethod : public ::testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(Solve, EveryMethod, ::testing::ValuesIn(test::kMethods),
                         test::method_test_name);

TEST(Solve, MethodsHaveTheirNames) {
  EXPECT_EQ(method_name(Method::conjugate_gradients), "cg");
  EXPECT_EQ(method_name(Method::jacobi), "jacobi");
  EXPECT_EQ(method_name(Method::gauss_seidel), "gauss-seidel");
  EXPECT_EQ(method_name(Method::southwell), "southwell");
  EXPECT_EQ(method_name(Method::chebyshev), "chebyshev");
}

TEST_P(EveryMethod, FurnaceIsUniform) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_closed(16, random);
  const Eigen::MatrixXd exitance = Eigen::MatrixXd::Constant(16, 4, 2.5);
  Eigen::MatrixXd reflectance(16, 4);
  const double rho[] = {0.1, 0.5, 0.9, 0.99};
  for (Index c = 0; c < 4; ++c) reflectance.col(c).setConstant(rho[c]);

  const Solution solution = solve(transport, exitance, reflectance, with_method(GetParam()));

  EXPECT_TRUE(solution.converged);
  for (Index c = 0; c < 4; ++c) {
    const double expected = 2.5 / (1 - rho[c]);
    const double error =
        energy_norm(transport.area(), (solution.radiosity.col(c).array() - expected).matrix());
    EXPECT_LE(error, 1e-8 * expected * std::sqrt(transport.area().sum())) << "rho " << rho[c];
  }
}

TEST_P(EveryMethod, AgreesWithDenseLuWithinItsBound) {
  std::mt19937_64 random(kSolveSeed);
  for (const double tolerance : {1e-1, 1e-4, 1e-8}) {
    for (int trial = 0; trial < 8; ++trial) {
      const DenseTestTransport transport =
          trial % 2 == 0 ? test::random_open(30, random) : test::random_closed(30, random);
      const double largest = trial < 4 ? 0.9 : 0.97;
      Eigen::MatrixXd reflectance = random_matrix(30, 3, -0.2, largest, random).cwiseMax(0);
      const Eigen::MatrixXd exitance = random_matrix(30, 3, -5, 1, random).cwiseMax(0);
      SolveOptions options = with_method(GetParam());
      options.tolerance = tolerance;

      const Solution solution = solve(transport, exitance, reflectance, options);

      const Eigen::MatrixXd expected =
          solve_directly(transport.form_factors(), exitance, reflectance);
      const double error = relative_error(transport.area(), solution.radiosity, expected);
      SCOPED_TRACE("tolerance " + std::to_string(tolerance) + ", trial " + std::to_string(trial));
      EXPECT_TRUE(solution.converged);
      EXPECT_LE(solution.error_bound, tolerance);
      EXPECT_LE(error, solution.error_bound);
      // LU and the product each leave about n roundings.
      const Eigen::MatrixXd gathered = transport.form_factors() * solution.radiosity;
      EXPECT_LE((solution.irradiance - gathered).norm(), 1e-13 * gathered.norm());
    }
  }
}

TEST_P(EveryMethod, StoppedEarlyStillTellsAValidBound) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::chamber_ring(5, 8, 0.1, random);
  const Eigen::MatrixXd reflectance = random_matrix(40, 1, 0.8, 0.95, random);
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(40, 1);
  exitance.topRows(3).setOnes();
  const Eigen::MatrixXd expected = solve_directly(transport.form_factors(), exitance, reflectance);
  for (int products = 1; products < 12; ++products) {
    SolveOptions options = with_method(GetParam());
    options.max_products = products;
    const Solution solution = solve(transport, exitance, reflectance, options);
    EXPECT_FALSE(solution.converged);
    EXPECT_LE(solution.products, products);
    EXPECT_LE(relative_error(transport.area(), solution.radiosity, expected), solution.error_bound);
  }
}

TEST_P(EveryMethod, SharedSolveEqualsSeparateSolves) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_open(25, random);
  const Eigen::MatrixXd reflectance = random_matrix(25, 2, 0, 0.9, random);
  const Eigen::MatrixXd exitance = random_matrix(25, 6, 0, 1, random);
  SolveOptions options = with_method(GetParam());
  options.tolerance = 4e-11;  // two solves then differ by at most 1e-10 of B

  const Solution together = solve(transport, exitance, reflectance, options);

  ASSERT_TRUE(together.converged);
  for (Index c = 0; c < 6; ++c) {
    const Solution alone = solve(transport, exitance.col(c), reflectance.col(c % 2), options);
    EXPECT_LE(relative_error(transport.area(), together.radiosity.col(c), alone.radiosity), 1e-10);
    EXPECT_EQ(together.reflectance.col(c), reflectance.col(c % 2));
  }
}

TEST_P(EveryMethod, EnergyIsBalanced) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_open(30, random);
  const Eigen::MatrixXd reflectance = random_matrix(30, 2, -0.2, 0.9, random).cwiseMax(0);
  const Eigen::MatrixXd exitance = random_matrix(30, 2, 0, 1, random);
  const Solution solution = solve(transport, exitance, reflectance, with_method(GetParam()));

  const Eigen::VectorXd leak = 1 - transport.form_factors().rowwise().sum().array();
  for (Index c = 0; c < 2; ++c) {
    const EnergyBalance& energy = solution.energy;
    EXPECT_NEAR(energy.emitted[c], transport.area().dot(exitance.col(c)),
                1e-12 * energy.emitted[c]);
    const double escaped =
        (transport.area().array() * leak.array() * solution.radiosity.col(c).array()).sum();
    EXPECT_NEAR(energy.escaped[c], escaped, 1e-12 * energy.emitted[c]);
    // The imbalance is Σ A ρ (F B - H) <= ‖A^½‖ ‖residual‖.
    const double allowed = solution.residual * energy_norm(transport.area(), exitance.col(c)) *
                           std::sqrt(transport.area().sum());
    EXPECT_NEAR(energy.absorbed[c] + energy.escaped[c], energy.emitted[c],
                allowed + 1e-12 * energy.emitted[c]);
    EXPECT_LE(allowed, 1e-7 * energy.emitted[c]);
  }
}

TEST_P(EveryMethod, BlackPatchesShowTheirOwnLightOnly) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_closed(20, random);
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(20, 1, 0.8);
  reflectance.topRows(8).setZero();
  const Eigen::MatrixXd exitance = random_matrix(20, 1, 0, 1, random);
  const Solution solution = solve(transport, exitance, reflectance, with_method(GetParam()));
  EXPECT_EQ(solution.radiosity.topRows(8), exitance.topRows(8));

  const Solution black =
      solve(transport, exitance, Eigen::MatrixXd::Zero(20, 1), with_method(GetParam()));
  EXPECT_TRUE(black.converged);
  EXPECT_EQ(black.iterations, 0);
  EXPECT_EQ(black.radiosity, exitance);
  EXPECT_LE((black.irradiance - transport.form_factors() * exitance).norm(), 1e-13);
}

TEST_P(EveryMethod, HiddenPatchStaysExactlyDark) {
  std::mt19937_64 random(kSolveSeed);
  DenseTestTransport room = test::random_closed(10, random);
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(11, 11);
  exchange.topLeftCorner(10, 10) = room.exchange();
  Eigen::VectorXd area(11);
  area << room.area(), 1;
  const DenseTestTransport transport(exchange, area);
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(11, 1);
  exitance(0) = 1;
  const Solution solution =
      solve(transport, exitance, Eigen::MatrixXd::Constant(11, 1, 0.5), with_method(GetParam()));
  EXPECT_EQ(solution.radiosity(10), 0);
}

TEST_P(EveryMethod, NoLightIsSolvedAtOnce) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_closed(10, random);
  for (const double rho : {0.5, 1.0}) {
    const Solution solution = solve(transport, Eigen::MatrixXd::Zero(10, 3),
                                    Eigen::MatrixXd::Constant(10, 1, rho), with_method(GetParam()));
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.iterations, 0);
    EXPECT_EQ(solution.error_bound, 0);
    EXPECT_EQ(solution.radiosity.norm(), 0);
    EXPECT_EQ(solution.energy.absorbed.norm(), 0);
  }
}

TEST_P(EveryMethod, WhitePatchesInOpenSceneAreSolved) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_open(20, random);
  const Eigen::MatrixXd white = Eigen::MatrixXd::Ones(20, 1);
  const Eigen::MatrixXd exitance = random_matrix(20, 1, 0, 1, random);
  const Solution solution = solve(transport, exitance, white, with_method(GetParam()));
  EXPECT_TRUE(solution.converged);
  const Eigen::MatrixXd expected = solve_directly(transport.form_factors(), exitance, white);
  EXPECT_LE(relative_error(transport.area(), solution.radiosity, expected), solution.error_bound);
}

TEST_P(EveryMethod, ReportsAndStops) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_closed(20, random);
  const Eigen::MatrixXd exitance = random_matrix(20, 1, 0, 1, random);
  const Eigen::MatrixXd reflectance = random_matrix(20, 1, 0.5, 0.9, random);
  std::vector<SolveStep> steps;
  std::string stage;
  SolveOptions options = with_method(GetParam());
  options.on_step = [&](const SolveStep& step) { steps.push_back(step); };
  options.progress.report = [&](std::string_view name, double done, double total,
                                std::string_view unit) {
    stage = std::string(name) + "/" + std::string(unit);
    EXPECT_LE(done, total * (1 + 1e-12));
  };
  solve(transport, exitance, reflectance, options);
  ASSERT_GE(steps.size(), 3u);
  const double work = GetParam() == Method::southwell ? 1. / 20 : 1;  // of a step, products
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_EQ(steps[k].iteration, static_cast<int>(k));
    EXPECT_NEAR(steps[k].products, 1 + work * static_cast<double>(k), 1e-9);
  }
  EXPECT_LT(steps.back().error_bound, 1e-6);
  EXPECT_EQ(stage, "solve/products");

  std::stop_source source;
  options.on_step = [&](const SolveStep& step) {
    if (step.iteration == 1) source.request_stop();
    EXPECT_LE(step.iteration, 1);
  };
  options.progress.stop = source.get_token();
  EXPECT_THROW(solve(transport, exitance, reflectance, options), Interrupted);
}

TEST_P(EveryMethod, GivesUpAtTheRoundingErrors) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_closed(15, random);
  SolveOptions options = with_method(GetParam());
  options.tolerance = 1e-30;
  const Solution solution = solve(transport, random_matrix(15, 1, 0, 1, random),
                                  random_matrix(15, 1, 0, 0.9, random), options);
  EXPECT_FALSE(solution.converged);
  EXPECT_LT(solution.error_bound, 1e-12);
  EXPECT_LT(solution.products, 10000);
}

TEST_P(EveryMethod, SphereHasItsClosedForm) {
  std::mt19937_64 random(kSolveSeed);
  const Eigen::VectorXd area = random_matrix(25, 1, 0.1, 2, random).col(0);
  const DenseTestTransport transport = test::sphere(area, area.sum());
  const Eigen::VectorXd exitance = random_matrix(25, 1, 0, 3, random).col(0);
  const Eigen::VectorXd rho = random_matrix(25, 1, 0, 1, random).col(0);
  const Solution solution = solve(transport, exitance, rho, with_method(GetParam()));
  const double h = area.dot(exitance) / area.sum() / (1 - area.dot(rho) / area.sum());
  EXPECT_LE(relative_error(area, solution.radiosity, exitance + h * rho), 1e-8);
}

TEST_P(EveryMethod, OpenSphereHasItsClosedForm) {
  const auto entry = known_case("spherical cavity with circular opening");
  const double fraction = number(entry.at("params").at("fraction"));
  const double rho = number(entry.at("params").at("rho"));
  std::mt19937_64 random(kSolveSeed);
  const Eigen::VectorXd area = random_matrix(20, 1, 0.1, 2, random).col(0);
  const DenseTestTransport transport = test::sphere(area, area.sum() / (1 - fraction));
  const Solution solution = solve(transport, Eigen::MatrixXd::Ones(20, 1),
                                  Eigen::MatrixXd::Constant(20, 1, rho), with_method(GetParam()));
  const double expected = number(entry.at("values").at("B"));
  EXPECT_LE(relative_error(area, solution.radiosity, Eigen::MatrixXd::Constant(20, 1, expected)),
            1e-8);
}

TEST_P(EveryMethod, CubeOfSixPatchesHasItsClosedForm) {
  const double opposite = number(known_case("directly opposed, distance 1").at("F12"));
  const double adjacent = number(known_case("perpendicular unit squares, common edge").at("F12"));
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Constant(6, 6, adjacent);
  for (Index i = 0; i < 6; ++i) {
    exchange(i, i) = 0;
    exchange(i, i ^ 1) = opposite;
  }
  const DenseTestTransport transport(exchange, Eigen::VectorXd::Ones(6));
  for (const char* name :
       {"unit cube, 6 patches (one per face)", "unit cube, 6 patches, rho=0.95"}) {
    const auto entry = known_case(name);
    const double rho = number(entry.at("params").at("rho"));
    Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(6, 1);
    exitance(0) = 1;
    const Solution solution =
        solve(transport, exitance, Eigen::MatrixXd::Constant(6, 1, rho), with_method(GetParam()));
    Eigen::VectorXd expected = Eigen::VectorXd::Constant(6, number(entry.at("values").at("B2")));
    expected[0] = number(entry.at("values").at("B0"));
    expected[1] = number(entry.at("values").at("B1"));
    EXPECT_LE(relative_error(transport.area(), solution.radiosity, expected), 1e-8) << name;
  }
}

TEST(Solve, ConjugateGradientsNeedFewProducts) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transports[] = {test::chamber_ring(10, 20, 0.02, random),
                                           test::rough_box({1, 1, 4}, 0.25)};
  for (const DenseTestTransport& transport : transports) {
    const Index n = transport.size();
    Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(n, 1);
    exitance.topRows(n / 30).setOnes();
    const long before = transport.n_products();
    const Solution solution = solve(transport, exitance, Eigen::MatrixXd::Constant(n, 1, 0.95));
    EXPECT_TRUE(solution.converged);
    EXPECT_LE(solution.products, 45);
    EXPECT_EQ(solution.products, static_cast<double>(transport.n_products() - before));
  }
}

TEST(Solve, ConvergedColumnsCostNothing) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::chamber_ring(5, 8, 0.02, random);
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(40, 2);
  exitance.topRows(4).setOnes();
  Eigen::MatrixXd reflectance(40, 2);
  reflectance << Eigen::VectorXd::Constant(40, 0.05), Eigen::VectorXd::Constant(40, 0.99);
  for (const Method method : {Method::conjugate_gradients, Method::jacobi, Method::chebyshev}) {
    const Solution fast =
        solve(transport, exitance.col(0), reflectance.col(0), with_method(method));
    const long before = transport.n_columns();
    const Solution both = solve(transport, exitance, reflectance, with_method(method));
    // The first product has 1 and ρ as extra columns, the last one of CG has both columns.
    EXPECT_LE(static_cast<double>(transport.n_columns() - before),
              both.products + fast.products + 4)
        << method_name(method);
  }
}

TEST(Solve, OneVeryWhitePatchDoesNotSpoilTheBound) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::random_closed(30, random);
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(30, 1, 0.5);
  reflectance(3) = 1;  // closed, so row sums alone prove nothing; but light leaves to grey patches
  const Eigen::MatrixXd exitance = random_matrix(30, 1, 0, 1, random);
  const Solution solution = solve(transport, exitance, reflectance);
  EXPECT_TRUE(solution.converged);
  const Eigen::MatrixXd expected = solve_directly(transport.form_factors(), exitance, reflectance);
  EXPECT_LE(relative_error(transport.area(), solution.radiosity, expected), solution.error_bound);
}

TEST(Solve, WhiteChambersWithAFarExitAreProvedToConverge) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport transport = test::chamber_ring(6, 6, 0.3, random);
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Ones(36, 1);
  reflectance.topRows(6).setConstant(0.3);  // three chambers away from the farthest white ones
  const Eigen::MatrixXd exitance = random_matrix(36, 1, 0, 1, random);
  const Solution solution = solve(transport, exitance, reflectance);
  EXPECT_TRUE(solution.converged);
  const Eigen::MatrixXd expected = solve_directly(transport.form_factors(), exitance, reflectance);
  EXPECT_LE(relative_error(transport.area(), solution.radiosity, expected), solution.error_bound);
}

/// Two closed rooms that do not see each other, 8 patches each.
DenseTestTransport two_rooms() {
  std::mt19937_64 random(kSolveSeed);
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(16, 16);
  exchange.topLeftCorner(8, 8) = test::random_closed(8, random).exchange();
  exchange.bottomRightCorner(8, 8) = test::random_closed(8, random).exchange();
  return test::close(exchange);
}

TEST(Solve, TrappedLightHasNoSolution) {
  std::mt19937_64 random(kSolveSeed);
  const DenseTestTransport room = test::random_closed(12, random);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(12, 1);
  for (const Method method : test::kMethods) {
    EXPECT_THROW(solve(room, ones, ones, with_method(method)), SolveError);
  }
  try {
    solve(room, ones, ones);
  } catch (const SolveError& error) {
    EXPECT_NE(std::string(error.what()).find("no solution"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("reflectance 1"), std::string::npos) << error.what();
  }

  const DenseTestTransport rooms = two_rooms();
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(16, 1, 0.5);
  reflectance.bottomRows(8).setOnes();
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(16, 1);
  exitance(12) = 1;
  EXPECT_THROW(solve(rooms, exitance, reflectance), SolveError);
}

TEST(Solve, DarkWhiteRoomGivesNoBoundAndSaysSo) {
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(16, 1, 0.5);
  reflectance.bottomRows(8).setOnes();
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(16, 1);
  exitance(2) = 1;
  const DenseTestTransport rooms = two_rooms();
  const Solution solution = solve(rooms, exitance, reflectance);
  EXPECT_FALSE(solution.converged);
  EXPECT_EQ(solution.error_bound, std::numeric_limits<double>::infinity());
  EXPECT_LE(solution.residual, 1e-8 * 2);
  EXPECT_EQ(solution.radiosity.bottomRows(8).norm(), 0);
  EXPECT_TRUE(solution.radiosity_error.allFinite());
}

TEST(Solve, RejectsWhatDoesNotFit) {
  const DenseTestTransport transport = test::sphere(Eigen::VectorXd::Ones(4), 4);
  const Eigen::MatrixXd good = Eigen::MatrixXd::Constant(4, 3, 0.5);
  const auto message = [&](const Eigen::MatrixXd& exitance, const Eigen::MatrixXd& reflectance) {
    try {
      solve(transport, exitance, reflectance);
    } catch (const SolveError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message(Eigen::MatrixXd::Ones(5, 3), good),
            "exitance is 5 x 3, but the transport has 4 patches; expected one row per patch");
  EXPECT_EQ(message(good, Eigen::MatrixXd::Zero(3, 3)),
            "reflectance is 3 x 3, but the transport has 4 patches; expected one row per patch");
  EXPECT_EQ(message(good, Eigen::MatrixXd::Zero(4, 2)),
            "exitance is 4 x 3 and reflectance 4 x 2; expected the columns of exitance to be a "
            "multiple of those of reflectance");
  Eigen::MatrixXd bad = good;
  bad(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(bad, good),
            "exitance of patch 2, column 1 is nan; expected a finite value of at least 0 W/m²");
  EXPECT_EQ(message(good, bad),
            "reflectance of patch 2, column 1 is nan; expected a value in [0, 1]");
  bad(2, 1) = 1.5;
  EXPECT_EQ(message(good, bad),
            "reflectance of patch 2, column 1 is 1.500000; expected a value in [0, 1]");
  bad(2, 1) = -1;
  EXPECT_NE(message(bad, good), "accepted");
}

}  // namespace
}  // namespace radiosity
