#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/factor_rows.h"

namespace viewer {

/// Another patch as a patch sees it.
struct Partner {
  radiosity::Index patch = -1;
  double factor = 0;  ///< F from the first one
  double error = 0;   ///< one standard error of it
};

/// The form factors from one patch.
struct FactorRow {
  radiosity::Index patch = -1;
  Eigen::VectorXd factors;        ///< F_ij to each patch j, n
  double sum = 0;                 ///< Σ_j F_ij
  std::vector<Partner> partners;  ///< the ten largest, the largest first
};

/// Row `patch` of the form factors between patches of these areas, m². Of a compressed operator it
/// takes a product.
FactorRow make_factor_row(const radiosity::FactorRows& factors, const std::vector<double>& areas,
                          radiosity::Index patch);

}  // namespace viewer
