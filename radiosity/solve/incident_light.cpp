#include "radiosity/solve/incident_light.h"

#include <cassert>

namespace radiosity {

Solution with_incident(Solution solution, const Eigen::MatrixXd& exitance,
                       const Eigen::MatrixXd& incident, const Eigen::VectorXd& area) {
  if (incident.size() == 0) return solution;
  assert(exitance.cols() % incident.cols() == 0 && incident.rows() == exitance.rows());
  solution.incident = incident.replicate(1, exitance.cols() / incident.cols());
  solution.irradiance += solution.incident;
  solution.exitance = exitance;
  const Eigen::MatrixXd reflected = solution.reflectance.cwiseProduct(solution.incident);
  solution.energy.emitted = exitance.transpose() * area;
  solution.energy.incident = solution.incident.transpose() * area;
  solution.energy.absorbed += (solution.incident - reflected).transpose() * area;
  return solution;
}

}  // namespace radiosity
