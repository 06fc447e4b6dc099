#include "radiosity/scene/luminous_opening.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace radiosity {
namespace {

/// Width over length of what has no width: off by its square over that of the distance.
constexpr double kThin = 1e-4;

}  // namespace

std::optional<LuminousOpening> luminous_opening(const Luminaire& luminaire,
                                                const Photometry& photometry) {
  if (luminaire.divisions != std::array{0, 0}) return std::nullopt;
  const double widest = std::max(photometry.along_c0, photometry.along_c90);
  LuminousOpening opening{.center = luminaire.position, .axis = -luminaire.axes.col(2)};
  if (photometry.height > widest) {
    const double width = std::max(widest, kThin * photometry.height);
    opening.is_tube = true;
    opening.half_u = 0.5 * photometry.height * luminaire.axes.col(2);
    opening.half_v = 0.5 * width * luminaire.axes.col(0);
    return opening;
  }
  if (!(widest > 0)) return std::nullopt;
  opening.is_round = photometry.is_round && photometry.along_c0 > 0 && photometry.along_c90 > 0;
  opening.half_u = 0.5 * std::max(photometry.along_c0, kThin * widest) * luminaire.axes.col(0);
  opening.half_v = 0.5 * std::max(photometry.along_c90, kThin * widest) * luminaire.axes.col(1);
  return opening;
}

LuminousOpening seen_from(const LuminousOpening& opening, const Vec3& point) {
  if (!opening.is_tube) return opening;
  const Vec3 across = opening.half_u.cross(point - opening.center);
  if (!(across.norm() > 0)) return opening;  // along the axis a web of a tube has no light
  LuminousOpening seen = opening;
  seen.half_v = opening.half_v.norm() * across.normalized();
  return seen;
}

}  // namespace radiosity
