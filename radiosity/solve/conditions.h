#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// All that a scene says of its light but the form factors, as `solve` takes it.
struct Conditions {
  Eigen::MatrixXd exitance;       ///< M_e, W/m², n x b; q where net heat is given
  Eigen::MatrixXd reflectance;    ///< n x b
  Eigen::MatrixXd incident = {};  ///< from without, of sun and environment, W/m², n x b; or empty
  Eigen::SparseMatrix<double> transmission = {};  ///< through shields, n x n; or empty
  /// What `incident` may be off, W/m², n x b; or empty: it is exact.
  Eigen::MatrixXd incident_error = {};
  Eigen::VectorXd emissivity = {};  ///< of the materials, n; empty unless the light is grey heat
};

/// What a scene says. `sun` is its sun's direct irradiance (incident_irradiance), W/m², n x b, or
/// empty. `added` is heat that patches take up besides, W/m², n or empty: it counts where the net
/// heat is given, and raises that; where a temperature is given it has to be carried off all the
/// same. `emissivity` is what each patch has at its temperature, n, or empty: as the materials say
/// (emissivity_at). Throws SceneError where heat is given in a scene whose bands are not grey.
Conditions make_conditions(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                           const Eigen::MatrixXd& sun = {}, const Eigen::VectorXd& added = {},
                           const Eigen::VectorXd& emissivity = {});

/// The options with what of the conditions they hold, for k columns of as many bands each.
SolveOptions with_conditions(SolveOptions options, const Conditions& conditions, Index n_columns);

/// Irradiance of each patch from surroundings of the exitance M_e, W/m², b, that it sees where it
/// meets neither fronts nor backs: (1 - Σ_j F_ij - covered - backs) M_e, n x b, not below 0.
Eigen::MatrixXd environment_irradiance(const Transport& transport, const Eigen::VectorXd& exitance);

/// What patches would have to be at, K, n: σ T⁴ = (B - (1 - ε) H) / ε, M_e / ε where they reflect 1
/// - ε (temperatures that were given come out as they were), of patches with ε = 0 B, as of an
/// adiabatic one. Of one grey band and `emissivity`, n. Throws SolveError where no
/// temperature gives off so little, with the patch and its surface.
Eigen::VectorXd temperatures(const PatchMesh& mesh, const Solution& solution,
                             const Eigen::VectorXd& emissivity);

}  // namespace radiosity
