#pragma once

#include <optional>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/luminaire.h"
#include "radiosity/scene/photometry.h"

namespace radiosity {

/// The part of a luminaire that light comes out of: a rectangle or an ellipse across its axis, or
/// what is seen of a standing tube. Each part of it gives its share of the flux by the luminaire's
/// web, so that far away it is a point, and one of a Lambertian web an area of even luminance.
struct LuminousOpening {
  Vec3 center = Vec3::Zero();  ///< m
  Vec3 half_u = Vec3::Zero();  ///< to the middle of one side, m
  Vec3 half_v = Vec3::Zero();  ///< of another one, at a right angle to that, m
  Vec3 axis = -Vec3::UnitZ();  ///< of the luminaire, unit
  bool is_round = false;       ///< an ellipse of these half axes
  bool is_tube = false;        ///< along the axis: half_u is its half length

  [[nodiscard]] Vec3 at(double u, double v) const { return center + u * half_u + v * half_v; }
};

/// That of a luminaire whose file tells of one and that has no `divisions` by hand. One that is
/// higher than it is wide is a tube; what has no width at all gets a ten-thousandth of its length.
std::optional<LuminousOpening> luminous_opening(const Luminaire& luminaire,
                                                const Photometry& photometry);

/// What is seen of it from a point: of a tube the rectangle through its axis that faces the point,
/// as wide as the tube; else the same.
LuminousOpening seen_from(const LuminousOpening& opening, const Vec3& point);

}  // namespace radiosity
