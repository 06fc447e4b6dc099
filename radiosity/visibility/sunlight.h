#pragma once

#include <Eigen/Core>

#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// The share of each patch's area that parallel light in a direction of unit length reaches,
/// n_patches, in [0, 1], by exact shadows: SunShadows::lit_shares. Throws Interrupted.
Eigen::VectorXd lit_shares(const PatchMesh& mesh, const Vec3& direction,
                           const Progress& progress = {});

/// Direct irradiance of the scene's sun on each patch, n_patches x n_bands, W/m²:
/// E = E_n cosθ · lit share, with exact shadows (SunShadows); empty without a sun. (1 - ρ) E is
/// what the patch absorbs of it before any reflection. Throws Interrupted, and SolveError for a
/// scene with a symmetry.
Eigen::MatrixXd sun_irradiance(const Scene& scene, const PatchMesh& mesh,
                               const Progress& progress = {});

/// What leaves each patch before light is exchanged, |M_e| + ρ E, n_patches x n_bands, W/m², as far
/// as it is known without form factors: the light that operators are made for. Heat that is taken
/// away counts like heat given.
Eigen::MatrixXd initial_radiosity(const Scene& scene, const PatchMesh& mesh,
                                  const Progress& progress = {});

}  // namespace radiosity
