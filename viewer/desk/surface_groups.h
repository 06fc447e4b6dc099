#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/desk/surface_totals.h"
#include "viewer/work/known.h"
#include "viewer/work/light_mix.h"

namespace viewer {

/// By what surfaces are listed.
enum class SurfaceListing { surfaces, materials, lamps };

/// Surfaces that belong together: those of a material, or of a lamp.
struct SurfaceGroup {
  std::size_t index = 0;  ///< of the material, or of the lamp in the mix
  std::string name;
  std::vector<std::int32_t> surfaces;  ///< rising
  std::optional<double> lumens = {};   ///< of luminaires, which have no surfaces, lm
};

/// One group for each material, in the scene's order, some without surfaces perhaps.
std::vector<SurfaceGroup> material_groups(const radiosity::Scene& scene);
/// One for each lamp (or source of heat) of a mix, but for sun and sky.
std::vector<SurfaceGroup> lamp_groups(const LightMix& mix);

/// What a group has as a whole. `totals` has one entry for each surface, in any order; fluxes and
/// heats are added, irradiance is the mean over the area.
SurfaceTotal group_total(const SurfaceGroup& group, const std::vector<SurfaceTotal>& totals);

}  // namespace viewer
