#include "tests/support/direct_solve.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace radiosity::test {

double energy_norm(const Eigen::VectorXd& area, const Eigen::VectorXd& b) {
  return std::sqrt(area.dot(b.cwiseAbs2()));
}

Eigen::MatrixXd solve_directly(const Eigen::MatrixXd& form_factors, const Eigen::MatrixXd& exitance,
                               const Eigen::MatrixXd& reflectance) {
  Eigen::MatrixXd b(exitance.rows(), exitance.cols());
  for (Index c = 0; c < b.cols(); ++c) {
    const Eigen::VectorXd rho = reflectance.col(c % reflectance.cols());
    const Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Identity(b.rows(), b.rows()) - rho.asDiagonal() * form_factors;
    b.col(c) = matrix.partialPivLu().solve(exitance.col(c));
  }
  return b;
}

double relative_error(const Eigen::VectorXd& area, const Eigen::MatrixXd& b,
                      const Eigen::MatrixXd& expected) {
  double largest = 0;
  for (Index c = 0; c < b.cols(); ++c) {
    largest = std::max(largest, energy_norm(area, b.col(c) - expected.col(c)) /
                                    energy_norm(area, expected.col(c)));
  }
  return largest;
}

SolveOptions with_method(Method method) {
  SolveOptions options;
  options.method = method;
  return options;
}

}  // namespace radiosity::test
