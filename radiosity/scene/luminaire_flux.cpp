#include "radiosity/scene/luminaire_flux.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace radiosity {

double tilt_factor(const LampTilt& tilt, double angle) {
  if (tilt.angles.empty()) return 1;
  const auto above = std::upper_bound(tilt.angles.begin(), tilt.angles.end(), angle);
  if (above == tilt.angles.begin()) return tilt.factors.front();
  if (above == tilt.angles.end()) return tilt.factors.back();
  const auto k = static_cast<std::size_t>(above - tilt.angles.begin());
  const double t = (angle - tilt.angles[k - 1]) / (tilt.angles[k] - tilt.angles[k - 1]);
  return (1 - t) * tilt.factors[k - 1] + t * tilt.factors[k];
}

double tilt_angle(const Luminaire& luminaire) {
  const Vec3 axis = luminaire.axes.col(2);  // straight up where it hangs straight down
  return std::atan2(axis.cross(luminaire.up).norm(), axis.dot(luminaire.up));
}

double tilt_factor(const Luminaire& luminaire, const Photometry& photometry) {
  return tilt_factor(photometry.tilt, tilt_angle(luminaire));
}

double undimmed_flux(const Luminaire& luminaire, const Photometry& photometry) {
  return tilt_factor(luminaire, photometry) *
         (luminaire.lumens > 0 ? luminaire.lumens : flux(photometry.web));
}

double web_factor(const Luminaire& luminaire, const Photometry& photometry) {
  const double own = luminaire.lumens > 0 ? luminaire.lumens / flux(photometry.web) : 1;
  return luminaire.dimming * own * tilt_factor(luminaire, photometry);
}

}  // namespace radiosity
