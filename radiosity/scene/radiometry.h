#pragma once

#include <Eigen/Core>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// Stefan-Boltzmann constant, W/(m² K⁴) (CODATA 2018).
inline constexpr double kStefanBoltzmann = 5.670374419e-8;

/// Radiant exitance M_e that each patch emits by itself, W/m², n_patches x n_bands.
/// From radiance L: M_e = π L. From the power Φ of a surface of total emitting area A (both sides
/// if two-sided): M_e = Φ / A. From temperature T: M_e = (1 - ρ) f σ T⁴ with
/// the share f of the band (thermal_fractions; 1 if it is one grey band). Each times the surface's
/// `emission_factor`.
Eigen::MatrixXd exitance(const Scene& scene, const PatchMesh& mesh);

/// What leaves each patch before light is exchanged, M_e + ρ E, W/m², n x k, with direct irradiance
/// E from without (of the sun); M_e if that is empty.
Eigen::MatrixXd initial_radiosity(const Eigen::MatrixXd& exitance,
                                  const Eigen::MatrixXd& reflectance,
                                  const Eigen::MatrixXd& incident);

/// Diffuse reflectance of each patch, in [0, 1], n_patches x n_bands.
Eigen::MatrixXd reflectance(const Scene& scene, const PatchMesh& mesh);

}  // namespace radiosity
