#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "tests/support/direct_solve.h"
#include "tests/support/matrix_transport.h"
#include "tests/support/messages.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::expect_contains;
using test::random_matrix;

constexpr std::uint64_t kPassedSeed = 20261127;

/// Patches of all kinds: the first are pairs that are the two sides of a sheet, each of one
/// temperature that floats; of the others every third passes on all and gives off heat, or takes it
/// up.
struct Enclosure {
  DenseTestTransport transport;
  Eigen::MatrixXd exitance;
  Eigen::MatrixXd reflectance;
  Eigen::MatrixXd incident;
  Eigen::SparseMatrix<double> transmission;

  [[nodiscard]] Eigen::MatrixXd passing() const {
    return Eigen::MatrixXd(transmission) + Eigen::MatrixXd(reflectance.col(0).asDiagonal());
  }
  /// H = F (M + R H) + H_0 by dense LU.
  [[nodiscard]] Eigen::MatrixXd radiosity() const {
    const Eigen::MatrixXd f = transport.form_factors();
    const Eigen::MatrixXd r = passing();
    const Eigen::Index n = f.rows();
    const Eigen::MatrixXd h =
        (Eigen::MatrixXd::Identity(n, n) - f * r).partialPivLu().solve(f * exitance + incident);
    return exitance + r * h;
  }
};

/// The exchange areas of random patches whose first 2 `n_sheets` have areas alike in pairs.
DenseTestTransport with_alike_pairs(Index n, Index n_sheets, bool is_closed,
                                    std::mt19937_64& random) {
  Eigen::MatrixXd g = random_matrix(n, n, 0, 1, random);
  g = (g + g.transpose()).eval();
  Eigen::VectorXd area = g.rowwise().sum();
  for (Index s = 0; s < n_sheets; ++s) {
    const Index thin = area[2 * s] < area[2 * s + 1] ? 2 * s : 2 * s + 1;
    const double lacking = std::abs(area[2 * s] - area[2 * s + 1]);
    g(thin, thin) += lacking;
    area[thin] += lacking;
  }
  return DenseTestTransport(is_closed ? g : 0.8 * g, area);
}

Enclosure random_enclosure(Index n, Index n_sheets, bool is_closed, std::mt19937_64& random) {
  Enclosure room{with_alike_pairs(n, n_sheets, is_closed, random),
                 random_matrix(n, 1, 0, 100, random),
                 random_matrix(n, 1, 0, 0.95, random),
                 random_matrix(n, 1, 0, 30, random),
                 {}};
  const Eigen::MatrixXd emissivity = random_matrix(n, 1, 0.02, 1, random);
  std::vector<Eigen::Triplet<double>> passed;
  for (Index s = 0; s < n_sheets; ++s) {
    const Index f = 2 * s;
    const double ef = emissivity(f, 0);
    const double eb = emissivity(f + 1, 0);
    room.exitance.middleRows(f, 2).setZero();
    room.reflectance(f, 0) = 1 - ef * eb / (ef + eb);
    room.reflectance(f + 1, 0) = 1 - ef * eb / (ef + eb);
    passed.emplace_back(f, f + 1, ef * eb / (ef + eb));
    passed.emplace_back(f + 1, f, ef * eb / (ef + eb));
  }
  for (Index i = 2 * n_sheets; i < n; i += 3) {
    room.reflectance(i, 0) = 1;
    if (i % 2 == 0) room.exitance(i, 0) *= -0.1;
  }
  room.transmission.resize(n, n);
  room.transmission.setFromTriplets(passed.begin(), passed.end());
  return room;
}

SolveOptions options_of(const Enclosure& room, Method method, double tolerance) {
  SolveOptions options;
  options.method = method;
  options.tolerance = tolerance;
  options.incident = room.incident;
  options.transmission = room.transmission;
  options.has_sinks = true;
  return options;
}

TEST(PassedLight, AgreesWithDenseLuWithinItsBound) {
  std::mt19937_64 random(kPassedSeed);
  for (int trial = 0; trial < 12; ++trial) {
    const Enclosure room = random_enclosure(20 + trial, trial % 5, trial % 2 == 0, random);
    const Eigen::MatrixXd expected = room.radiosity();
    for (const Method method : {Method::conjugate_gradients, Method::jacobi, Method::chebyshev}) {
      for (const double tolerance : {1e-2, 1e-9}) {
        const Solution solution = solve(room.transport, room.exitance, room.reflectance,
                                        options_of(room, method, tolerance));
        const std::string what = std::string(method_name(method)) + " " + std::to_string(trial);
        EXPECT_TRUE(solution.converged) << what;
        EXPECT_LE(test::relative_error(room.transport.area(), solution.radiosity, expected),
                  solution.error_bound + 1e-12)
            << what;
      }
    }
  }
}

TEST(PassedLight, RowsOfFTakeIncidentLight) {
  std::mt19937_64 random(kPassedSeed);
  for (const bool is_closed : {false, true}) {
    const Enclosure room = random_enclosure(24, 0, is_closed, random);
    const Eigen::MatrixXd expected = room.radiosity();
    for (const Method method : {Method::gauss_seidel, Method::southwell}) {
      const Solution solution =
          solve(room.transport, room.exitance, room.reflectance, options_of(room, method, 1e-6));
      EXPECT_TRUE(solution.converged) << method_name(method);
      EXPECT_LE(test::relative_error(room.transport.area(), solution.radiosity, expected),
                solution.error_bound + 1e-12)
          << method_name(method);
    }
  }
}

TEST(PassedLight, BalancesEnergy) {
  std::mt19937_64 random(kPassedSeed);
  for (const bool is_closed : {false, true}) {
    const Enclosure room = random_enclosure(30, 4, is_closed, random);
    const Solution solution = solve(room.transport, room.exitance, room.reflectance,
                                    options_of(room, Method::conjugate_gradients, 1e-12));
    const EnergyBalance& energy = solution.energy;
    EXPECT_NEAR(energy.emitted[0] + energy.incident[0], energy.absorbed[0] + energy.escaped[0],
                1e-10 * energy.incident[0]);
    // A sheet gives off what it takes up.
    const Eigen::MatrixXd net = solution.net_flux();
    for (Index s = 0; s < 4; ++s) {
      EXPECT_NEAR(net(2 * s, 0), -net(2 * s + 1, 0), 1e-9 * solution.irradiance(2 * s, 0));
    }
  }
}

// T⁴ = (T1⁴ + T2⁴) / 2 between infinite plates that are alike, and with n sheets between them the
// heat is 1 / (n + 1) of that without: each patch sees the opposite one only.
TEST(PassedLight, SheetsBetweenPlates) {
  for (const Index n_sheets : {1, 2, 5}) {
    const double emissivity = 0.1;
    const Index n = 2 * n_sheets + 2;
    Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; i += 2) exchange(i, i + 1) = exchange(i + 1, i) = 3;
    const DenseTestTransport gaps(exchange, Eigen::VectorXd::Constant(n, 3));
    Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(n, 1);
    exitance(0, 0) = emissivity * 500;
    exitance(n - 1, 0) = emissivity * 100;
    Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(n, 1, 1 - emissivity / 2);
    reflectance(0, 0) = reflectance(n - 1, 0) = 1 - emissivity;
    SolveOptions options;
    options.tolerance = 1e-10;
    options.transmission.resize(n, n);
    for (Index i = 1; i + 1 < n; i += 2) {
      options.transmission.insert(i, i + 1) = emissivity / 2;
      options.transmission.insert(i + 1, i) = emissivity / 2;
    }
    const Solution solution = solve(gaps, exitance, reflectance, options);
    EXPECT_TRUE(solution.converged);
    const double heat = 400 / (2 / emissivity - 1) / static_cast<double>(n_sheets + 1);
    // ‖ΔB‖ <= 1e-10 ‖B‖, of patches of some 500 W/m² at most; H = F B is no more wrong.
    const double error = 2e-10 * 500 * std::sqrt(static_cast<double>(n));
    EXPECT_NEAR(solution.net_flux()(0, 0), heat, error);
    if (n_sheets > 1) continue;
    const double b = solution.radiosity(1, 0);
    const double h = solution.irradiance(1, 0);
    EXPECT_NEAR((b - (1 - emissivity) * h) / emissivity, 300, 2 * error / emissivity);
  }
}

TEST(PassedLight, ClosedGroupsWithHeatAreRefused) {
  std::mt19937_64 random(kPassedSeed);
  Enclosure room = random_enclosure(8, 4, true, random);
  room.exitance(0, 0) = 1;
  EXPECT_THROW((void)solve(room.transport, room.exitance, room.reflectance,
                           options_of(room, Method::conjugate_gradients, 1e-6)),
               SolveError);
}

TEST(PassedLight, BadInputIsRefused) {
  std::mt19937_64 random(kPassedSeed);
  const Enclosure room = random_enclosure(12, 2, true, random);
  const auto message = [&](const SolveOptions& options) -> std::string {
    try {
      (void)solve(room.transport, room.exitance, room.reflectance, options);
    } catch (const SolveError& error) {
      return error.what();
    }
    return "";
  };
  const SolveOptions good = options_of(room, Method::conjugate_gradients, 1e-6);
  EXPECT_EQ(message(good), "");
  SolveOptions bad = good;
  bad.incident.resize(3, 1);
  expect_contains(message(bad), "incident is 3 x 1");
  bad = good;
  bad.incident(4, 0) = -1;
  expect_contains(message(bad), "incident of patch 4");
  bad = good;
  bad.transmission.resize(3, 3);
  expect_contains(message(bad), "transmission is 3 x 3");
  bad = good;
  bad.transmission *= 2;
  expect_contains(message(bad), "expected at most 1");
  bad = good;
  bad.has_sinks = false;
  expect_contains(message(bad), "exitance of patch");
  bad = good;
  bad.method = Method::southwell;
  expect_contains(message(bad), "expected cg, jacobi or chebyshev");
}

}  // namespace
}  // namespace radiosity
