#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "radiosity/solve.h"

namespace radiosity::testing {

/// ‖B‖ = sqrt(Σ A B²), the norm in which the bounds hold.
inline double energy_norm(const Eigen::VectorXd& area, const Eigen::VectorXd& b) {
  return std::sqrt(area.dot(b.cwiseAbs2()));
}

/// Eigen's dense LU, column by column: the plain reference.
inline Eigen::MatrixXd solve_directly(const Eigen::MatrixXd& form_factors,
                                      const Eigen::MatrixXd& exitance,
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

/// Largest true relative error over the columns, energy norm.
inline double relative_error(const Eigen::VectorXd& area, const Eigen::MatrixXd& b,
                             const Eigen::MatrixXd& expected) {
  double largest = 0;
  for (Index c = 0; c < b.cols(); ++c) {
    largest = std::max(largest, energy_norm(area, b.col(c) - expected.col(c)) /
                                    energy_norm(area, expected.col(c)));
  }
  return largest;
}

inline SolveOptions with_method(Method method) {
  SolveOptions options;
  options.method = method;
  return options;
}

}  // namespace radiosity::testing
