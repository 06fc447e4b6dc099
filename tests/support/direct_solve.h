#pragma once

#include "radiosity/base/geometry.h"
#include "radiosity/solve/solution.h"

namespace radiosity::test {

/// ‖B‖ = sqrt(Σ A B²), the norm in which the bounds hold.
double energy_norm(const Eigen::VectorXd& area, const Eigen::VectorXd& b);

/// Eigen's dense LU, column by column: the plain reference.
Eigen::MatrixXd solve_directly(const Eigen::MatrixXd& form_factors, const Eigen::MatrixXd& exitance,
                               const Eigen::MatrixXd& reflectance);

/// Largest true relative error over the columns, energy norm.
double relative_error(const Eigen::VectorXd& area, const Eigen::MatrixXd& b,
                      const Eigen::MatrixXd& expected);

SolveOptions with_method(Method method);

}  // namespace radiosity::test
