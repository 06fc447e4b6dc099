#include "radiosity/solve/importance.h"

#include <string>

#include "radiosity/solve/solve.h"

namespace radiosity {

Eigen::MatrixXd importance(const Transport& transport, const Eigen::MatrixXd& reflectance,
                           Index patch, const SolveOptions& options) {
  if (patch < 0 || patch >= transport.size()) {
    throw SolveError("there is no patch " + std::to_string(patch) + "; expected one of the " +
                     std::to_string(transport.size()) + " patches, counted from 0");
  }
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(transport.size(), reflectance.cols());
  if (reflectance.rows() == transport.size()) {  // if not, solve will say so
    exitance.row(patch) = reflectance.row(patch) / transport.area()[patch];
  }
  SolveOptions quick = options;
  quick.estimates_errors = false;
  const Solution adjoint = solve(transport, exitance, reflectance, quick);
  Eigen::MatrixXd result = transport.area().asDiagonal() * adjoint.irradiance;
  result.row(patch).array() += 1;
  return result;
}

}  // namespace radiosity
