#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"

namespace radiosity {

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
  QuantityInfo info;
  std::string unit;
  /// In the scene's order; those without patches are left out.
  std::vector<QuantityShare> surfaces;
  QuantityShare total;  ///< of all patches
};

/// The quantity's sums, means and extremes on each surface of the mesh that it is of.
QuantitySummary summarize(const QuantityField& field, const PatchMesh& mesh);

}  // namespace radiosity
