#pragma once

#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"

namespace apps {

/// A quantity on one surface, or on all. One value per column of the quantity; of an additive
/// quantity there is only the sum, else there are mean, minimum and maximum.
struct QuantityShare {
  std::string surface;
  double area = 0;           ///< m², both sides of a two-sided surface
  Eigen::VectorXd sum;       ///< over the patches
  Eigen::VectorXd mean;      ///< area-weighted
  Eigen::VectorXd least;     ///< over the patches
  Eigen::VectorXd greatest;  ///< over the patches
};

/// A quantity by surface.
struct QuantitySummary {
  radiosity::QuantityInfo info;
  std::string unit;
  std::vector<QuantityShare>
      surfaces;         ///< in the scene's order; those without patches are left out
  QuantityShare total;  ///< of all patches
};

QuantitySummary summarize(const radiosity::QuantityField& field, const radiosity::PatchMesh& mesh);

}  // namespace apps
