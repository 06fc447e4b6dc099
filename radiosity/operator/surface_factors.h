#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Form factors between whole surfaces, n_surfaces x n_surfaces: F_st is the share of the power
/// that leaves surface s, evenly over its area, and reaches surface t. F_st = Σ_{i in s} A_i Σ_{j
/// in t} F_ij / Σ_{i in s} A_i. Exactly 0 of a flat or convex surface to itself.
Eigen::MatrixXd surface_form_factors(const PatchMesh& mesh, const Transport& transport);

/// One standard error of each of these factors. Patch pairs are independent, but a pair within one
/// surface counts twice.
Eigen::MatrixXd surface_form_factor_errors(const PatchMesh& mesh, const Transport& transport);

/// The same from rows of F that come one after the other, 0 to n - 1.
class SurfaceFactorSums {
 public:
  explicit SurfaceFactorSums(const PatchMesh& mesh);
  void add_row(Index i, const Eigen::VectorXd& row);
  /// Once all rows were added.
  [[nodiscard]] Eigen::MatrixXd factors() const;

 private:
  const PatchMesh& mesh_;
  Eigen::MatrixXd exchange_;  // m²
};

/// Area of each surface, all its patches together (both sides if two-sided), m².
Eigen::VectorXd surface_areas(const PatchMesh& mesh);

}  // namespace radiosity
