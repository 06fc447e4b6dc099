#pragma once

#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/luminaire.h"
#include "radiosity/scene/photometry.h"

namespace radiosity {

/// Where the points of a luminaire are, m: the middles of as many parts of equal area of its
/// luminous opening, a rectangle or an ellipse, as `divisions` says. Each has the same share of the
/// flux, by the same web. One alone is at the position. Without divisions it is `automatic` along
/// sides that have an extent, and one along the others.
std::vector<Vec3> luminaire_points(const Luminaire& luminaire, const Photometry& photometry,
                                   int automatic = 1);

}  // namespace radiosity
