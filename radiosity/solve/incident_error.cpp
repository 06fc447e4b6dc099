#include "radiosity/solve/incident_error.h"

#include "radiosity/solve/solution_error.h"

namespace radiosity {

Solution with_incident_error(Solution solution, const Transport& transport,
                             const Eigen::MatrixXd& error, const Progress& progress) {
  if (error.size() == 0 || error.isZero(0) || solution.radiosity_error.size() == 0) return solution;
  const Index n_repeats = error.cols() / solution.reflectance.cols();
  const Eigen::MatrixXd sources = solution.reflectance.replicate(1, n_repeats).cwiseProduct(error);
  const Eigen::MatrixXd shift =
      sources + reflected_light(transport, solution, sources, progress).cwiseMax(0);
  solution.radiosity_error = (solution.radiosity_error.cwiseAbs2() + shift.cwiseAbs2()).cwiseSqrt();
  return solution;
}

}  // namespace radiosity
