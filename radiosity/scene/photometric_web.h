#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// The luminous intensity of a luminaire by direction. Its frame is that of the luminaire as it
/// hangs: x along C0, y along C90, -z straight down, C counter-clockwise seen from above. The
/// intensity is bilinear in the two angles between those that are given, and 0 beyond them.
/// Direction by type (IES LM-63; CIE 121, EN 13032-1), with x to the right and y upwards for who
/// looks along the axis -z of a floodlight:
///  C: (sin γ cos C, sin γ sin C, -cos γ), γ the vertical angle, C the horizontal one
///  B: (sin H, cos H sin V, -cos H cos V), about a horizontal axis
///  A: (cos V sin H, sin V, -cos V cos H), about a vertical axis
struct PhotometricWeb {
  enum class Type { c, b, a };
  Type type = Type::c;
  std::vector<double> polar;  ///< γ; π/2 + H of B, π/2 + V of A: increasing, in [0, π], 2 or more
  /// C; V of B, H of A: increasing, over 2π at most; one alone: the same all around.
  std::vector<double> azimuth;
  Eigen::MatrixXd intensity;  ///< cd, >= 0, n_polar x n_azimuth
};

/// What polar angles are from, and azimuths are from and towards, unit vectors.
struct PolarAxes {
  Vec3 pole;
  Vec3 zero;
  Vec3 quarter;
};
PolarAxes polar_axes(PhotometricWeb::Type type);

/// The intensity in a direction of any length but 0 in the luminaire's frame, cd.
double intensity(const PhotometricWeb& web, const Vec3& direction);

/// Φ = ∫ I dΩ of the bilinear intensity, exactly but for rounding, lm.
double flux(const PhotometricWeb& web);

/// The part of it with γ <= π/2 of a web of type C, lm.
double downward_flux(const PhotometricWeb& web);

/// What values at the ends of [from, to], linear between, weigh in ∫ f(θ) sin θ dθ.
std::array<double, 2> polar_weights(double from, double to);

/// The places k and k + 1 of increasing numbers, two or more, between which x lies, and how far it
/// is from the one to the other; beyond the ends the last of them, at 0 or 1.
struct Interval {
  Index k;
  double share;
};
Interval interval_of(const std::vector<double>& increasing, double x);

/// x or what differs from it by whole turns, so that it lies among the azimuths if that can be.
double turned_into(const std::vector<double>& azimuth, double x);

}  // namespace radiosity
