#pragma once

#include <Eigen/Core>

namespace radiosity {

/// Light on patches that comes from no patch. Empty if there is none.
struct IncidentIrradiance {
  Eigen::MatrixXd irradiance = {};  ///< W/m², n_patches x n_bands
  /// What quadrature may have left of it, W/m² of the brightest band, n_patches; 0 where it is
  /// exact.
  Eigen::VectorXd error = {};
};

}  // namespace radiosity
