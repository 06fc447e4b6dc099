#pragma once

#include <array>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/luminaire.h"
#include "radiosity/scene/photometry.h"

namespace viewer {

/// Lines, m, that show a luminaire in the scene. Places on its curves are as far from its position
/// as their intensity is of the peak, which is `size` away.
struct LuminaireShape {
  using Curve = std::vector<radiosity::Vec3>;
  Curve opening;                       ///< its luminous opening, closed; empty without one
  std::array<radiosity::Vec3, 2> aim;  ///< from the position along the axis, `size` long
  std::array<Curve, 2> planes;         ///< polar curves in C0-C180 and C90-C270, closed
  std::vector<Curve> solid = {};       ///< meridians and parallels of the photometric solid
};

/// Whether the photometric solid is wanted, too.
enum class LuminaireDetail { curves, solid };

/// The shape of a luminaire whose longest line is `size`, m.
LuminaireShape luminaire_shape(const radiosity::Luminaire& luminaire,
                               const radiosity::Photometry& photometry, double size,
                               LuminaireDetail detail);

}  // namespace viewer
