#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "radiosity/scene/patch_material.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// Stefan-Boltzmann constant, W/(m² K⁴) (CODATA 2018).
inline constexpr double kStefanBoltzmann = 5.670374419e-8;

/// Radiant exitance M_e that each patch emits by itself, W/m², n_patches x n_bands.
/// From radiance L: M_e = π L. From the power Φ of a surface of total emitting area A (both sides
/// if two-sided): M_e = Φ / A. From temperature T: M_e = (1 - ρ) f σ T⁴ with the share f of the
/// band (thermal_fractions; 1 if it is one grey band). A patch whose net heat q = B - H is given
/// has M_e = q, which may be negative, and the reflectance 1; sides of a shield have their shares
/// of the heat given to both. Each times the surface's `emission_factor`. Temperatures and net
/// heats of single patches (patch_heat) count in place of all that. `emissivity`, n or empty, is
/// what each patch has at its temperature, of one grey band, where that is not its material's 1 -
/// ρ.
Eigen::MatrixXd exitance(const Scene& scene, const PatchMesh& mesh,
                         const Eigen::VectorXd& emissivity = {});

/// What leaves each patch before light is exchanged, M_e + ρ E, W/m², n x k, with irradiance E from
/// without, n x b; M_e if that is empty.
Eigen::MatrixXd initial_radiosity(const Eigen::MatrixXd& exitance,
                                  const Eigen::MatrixXd& reflectance,
                                  const Eigen::MatrixXd& incident);

/// What each patch sends back of its irradiance, in [0, 1], n_patches x n_bands: the diffuse
/// reflectance of its material or the mean of its texture, 1 where its net heat is given. Of a
/// shield with the emissivities ε and ε' of its sides, σ T⁴ = (ε H + ε' H') / (ε + ε') as no net
/// heat is left, so that B = ε σ T⁴ + (1 - ε) H sends back 1 - ε ε' / (ε + ε').
Eigen::MatrixXd reflectance(const Scene& scene, const PatchMesh& mesh,
                            const Eigen::VectorXd& emissivity = {});

/// The rest, ε ε' / (ε + ε'), which shields pass on to their other side, n_patches x n_patches;
/// empty if there are none.
Eigen::SparseMatrix<double> transmission(const Scene& scene, const PatchMesh& mesh,
                                         const Eigen::VectorXd& emissivity = {});

/// 1 - ρ of the patches' materials, n_patches x n_bands.
Eigen::MatrixXd emissivity(const Scene& scene, const PatchMesh& mesh);

/// M_e of what patches see of the environment, W/m², n_bands; empty if it is dark.
Eigen::VectorXd environment_exitance(const Scene& scene);

}  // namespace radiosity
