#pragma once

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
  double area = 0;  ///< m², both sides of a two-sided surface
  double flux = 0;  ///< area-weighted mean of B - H, W/m²
  double heat = 0;  ///< Σ A (B - H), W
  /// Area-weighted mean of what its patches are at, K, if that is known.
  std::optional<double> temperature = {};
};

/// Whether any surface's material emits by its temperature or gives off a given heat, or what
/// surrounds them has a temperature.
bool is_thermal(const Scene& scene);

/// One entry per surface, in the scene's order; bands are added up.
std::vector<SurfaceFlux> surface_fluxes(const PatchMesh& mesh, const Solution& solution);

}  // namespace radiosity
