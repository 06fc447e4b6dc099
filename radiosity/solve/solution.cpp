#include "radiosity/solve/solution.h"

namespace radiosity {

Eigen::MatrixXd Solution::passed_on(const Eigen::MatrixXd& received) const {
  Eigen::MatrixXd result = reflectance.cwiseProduct(received);
  if (transmission.nonZeros() > 0) result += transmission * received;
  return result;
}

Eigen::MatrixXd Solution::exchanged_irradiance() const {
  if (incident.size() == 0) return irradiance;
  return irradiance - incident;
}

Eigen::MatrixXd Solution::exchanged_radiosity() const {
  Eigen::MatrixXd result = radiosity - exitance;
  if (incident.size() > 0) result -= passed_on(incident);
  return result;
}

}  // namespace radiosity
