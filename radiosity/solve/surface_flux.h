#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// Net heat that a surface loses by radiation (negative: gains).
struct SurfaceFlux {
  std::string surface;
  double area = 0;            ///< m², both sides of a two-sided surface
  double flux = 0;            ///< area-weighted mean of B - H, W/m²
  double heat = 0;            ///< Σ A (B - H), W
  Eigen::VectorXd band_heat;  ///< the same by band, W; of a sun's own band less than 0: absorbed
  /// Area-weighted mean of what its patches are at, K, if that is known.
  std::optional<double> temperature = {};
};

/// Whether the light is heat: a surface emits by its temperature, gives off a given heat or is a
/// shield, what surrounds them has a temperature, or the bands are the sun's and the infrared one,
/// or thermal ones.
bool is_thermal(const Scene& scene);

/// One entry per surface, in the scene's order; bands are added up.
std::vector<SurfaceFlux> surface_fluxes(const PatchMesh& mesh, const Solution& solution);

}  // namespace radiosity
