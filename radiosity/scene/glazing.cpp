#include "radiosity/scene/glazing.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Through two faces of reflectance r, over and over.
double through_both(double r) { return (1 - r) / (1 + r); }

}  // namespace

double Glazing::at(double cosine, Eigen::Index band) const {
  const double inside = transmittance[band];
  if (refractive_index == 0) return inside;
  const double c = std::clamp(std::abs(cosine), 0., 1.);
  const double n = refractive_index;
  const double refracted = std::sqrt(1 - (1 - c * c) / (n * n));
  const double s = (c - n * refracted) / (c + n * refracted);
  const double p = (n * c - refracted) / (n * c + refracted);
  const double faces = 0.5 * (through_both(s * s) + through_both(p * p));
  return faces * (is_by_thickness ? std::pow(inside, 1 / refracted) : inside);
}

Eigen::VectorXd Glazing::at(double cosine) const {
  Eigen::VectorXd result(transmittance.size());
  for (Eigen::Index band = 0; band < result.size(); ++band) result[band] = at(cosine, band);
  return result;
}

}  // namespace radiosity
