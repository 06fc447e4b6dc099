// What light from without may be off, in the errors of the radiosity.
#include "radiosity/solve/incident_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "radiosity/solve/solve.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {

// In a closed room of one reflectance ρ light that is off by δ all over leaves B off by ρ δ / (1 -
// ρ).
TEST(IncidentError, IsReflectedToAndFro) {
  std::mt19937_64 random(7);
  const test::DenseTestTransport transport = test::random_closed(30, random);
  const Eigen::MatrixXd exitance = Eigen::MatrixXd::Constant(30, 2, 1);
  for (const double rho : {0., 0.3, 0.8}) {
    Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(30, 2, rho);
    Solution solution = solve(transport, exitance, reflectance);
    const Eigen::MatrixXd own = Eigen::MatrixXd::Constant(30, 2, 0.003);
    solution.radiosity_error = own;
    Eigen::MatrixXd off(30, 2);
    off.col(0).setConstant(0.01);
    off.col(1).setConstant(0.002);
    const Eigen::MatrixXd found = with_incident_error(solution, transport, off).radiosity_error;
    for (Index band = 0; band < 2; ++band) {
      const double expected = std::hypot(0.003, off(0, band) * rho / (1 - rho));
      // Propagated to 1 %.
      EXPECT_LT((found.col(band).array() - expected).abs().maxCoeff(), 0.015 * expected) << rho;
    }
    EXPECT_EQ(with_incident_error(solution, transport, {}).radiosity_error, own);
    solution.radiosity_error.resize(0, 0);
    EXPECT_EQ(with_incident_error(solution, transport, off).radiosity_error.size(), 0);
  }
}

}  // namespace
}  // namespace radiosity
