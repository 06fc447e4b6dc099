#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace viewer {

/// The light that one surface sends to a patch.
struct Arrival {
  std::int32_t surface = 0;
  Eigen::VectorXd irradiance;  ///< Σ_j F_ij B_j over its patches j, W/m², per band
  double share = 0;            ///< of the patch's irradiance, mean over the bands, in [0, 1]
};

/// Where the irradiance H_i = Σ_j F_ij B_j of patch i comes from, by surface, the largest share
/// first; surfaces that send nothing are left out. `row` is F_ij, `radiosity` n x b.
std::vector<Arrival> arrivals(const radiosity::PatchMesh& mesh, const Eigen::VectorXd& row,
                              const Eigen::MatrixXd& radiosity, const radiosity::Bands& bands);

/// The same patch by patch: F_ij B_j / A_j, W/m² for each m² of patch j, so that the size of the
/// patches does not show. n x b.
Eigen::MatrixXd arrival_density(const radiosity::PatchMesh& mesh, const Eigen::VectorXd& row,
                                const Eigen::MatrixXd& radiosity);

}  // namespace viewer
