#include "radiosity/scene/photometry.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Intensities that differ by less than this share of the greatest one are the same.
constexpr double kSameIntensity = 1e-9;

Vec3 web_direction(const PhotometricWeb& web, double polar, double azimuth) {
  const PolarAxes axes = polar_axes(web.type);
  return std::cos(polar) * axes.pole +
         std::sin(polar) * (std::cos(azimuth) * axes.zero + std::sin(azimuth) * axes.quarter);
}

/// A direction by γ and C.
Vec3 c_direction(double gamma, double plane) {
  return {std::sin(gamma) * std::cos(plane), std::sin(gamma) * std::sin(plane), -std::cos(gamma)};
}

/// Angles to the axis, 0 to π, between which the intensity is linear in the planes C0, C90, and in
/// any of a web of type C.
std::vector<double> profile_angles(const PhotometricWeb& web) {
  std::vector<double> angles{0, kPi};
  const bool is_c = web.type == PhotometricWeb::Type::c;
  for (const double polar : web.polar) angles.push_back(std::abs(is_c ? polar : polar - kPi / 2));
  if (!is_c) {
    for (const double azimuth : web.azimuth) angles.push_back(std::abs(azimuth));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// Whether all given intensities are those of a mirrored direction.
template <typename Mirror>
bool is_alike(const PhotometricWeb& web, const Mirror& mirror) {
  const double slack = kSameIntensity * web.intensity.maxCoeff();
  for (std::size_t i = 0; i < web.polar.size(); ++i) {
    for (std::size_t j = 0; j < web.azimuth.size(); ++j) {
      const Vec3 there = mirror(web_direction(web, web.polar[i], web.azimuth[j]));
      const double here = web.intensity(static_cast<Index>(i), static_cast<Index>(j));
      if (std::abs(intensity(web, there) - here) > slack) return false;
    }
  }
  return true;
}

/// How far from the axis the last direction with that intensity is in a half-plane.
double last_angle(const PhotometricWeb& web, double plane, double level) {
  const std::vector<double> angles = profile_angles(web);
  for (std::size_t k = angles.size() - 1; k > 0; --k) {
    const double beyond = intensity(web, c_direction(angles[k], plane));
    const double before = intensity(web, c_direction(angles[k - 1], plane));
    if (beyond >= level) return angles[k];
    if (before < level) continue;
    const double middle = intensity(web, c_direction(0.5 * (angles[k - 1] + angles[k]), plane));
    if (middle == 0) return angles[k - 1];  // the web ends there
    return angles[k - 1] + (angles[k] - angles[k - 1]) * (before - level) / (before - beyond);
  }
  return 0;
}

}  // namespace

WebSymmetry symmetry_of(const PhotometricWeb& web) {
  const double slack = kSameIntensity * web.intensity.maxCoeff();
  const bool is_whole = web.azimuth.back() - web.azimuth.front() > 2 * kPi - kSameIntensity;
  const bool is_even =
      (web.intensity.colwise() - web.intensity.col(0)).cwiseAbs().maxCoeff() <= slack;
  return {.is_rotational = web.type == PhotometricWeb::Type::c && is_even &&
                           (web.azimuth.size() == 1 || is_whole),
          .across_c0 = is_alike(web, [](const Vec3& d) { return Vec3(d.x(), -d.y(), d.z()); }),
          .across_c90 = is_alike(web, [](const Vec3& d) { return Vec3(-d.x(), d.y(), d.z()); })};
}

PeakIntensity peak_intensity(const PhotometricWeb& web) {
  Index row = 0;
  Index column = 0;
  const double peak = web.intensity.maxCoeff(&row, &column);
  return {peak, web_direction(web, web.polar[static_cast<std::size_t>(row)],
                              web.azimuth[static_cast<std::size_t>(column)])};
}

double spread(const PhotometricWeb& web, double plane, double share) {
  const double level = share * web.intensity.maxCoeff();
  if (!(level > 0)) return 0;
  return last_angle(web, plane, level) + last_angle(web, plane + kPi, level);
}

}  // namespace radiosity
