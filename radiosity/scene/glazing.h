#pragma once

#include <Eigen/Core>

namespace radiosity {

/// What a pane lets through of light from the sun and the sky. It goes on in the direction that it
/// had; what the pane reflects is its material's reflectance, diffuse.
struct Glazing {
  /// n of the pane, > 1: Fresnel's share through both faces, all reflections between them counted,
  /// mean of both polarisations (Born & Wolf, 1.5): ((1-r_s)/(1+r_s) + (1-r_p)/(1+r_p)) / 2.
  /// 0: the same share at all angles.
  double refractive_index = 0;
  /// Of what is not reflected: per band, in [0, 1]; at all angles alike, unless it is by the way
  /// through the pane.
  Eigen::VectorXd transmittance;
  /// Whether `transmittance` is that at normal incidence and falls with the way through the pane,
  /// τ^(1/cosθ'), cosθ' by Snell's law (Bouguer); of a refractive index only.
  bool is_by_thickness = false;

  /// At the angle θ from the normal, per band.
  [[nodiscard]] Eigen::VectorXd at(double cosine) const;
  /// Of one band.
  [[nodiscard]] double at(double cosine, Eigen::Index band) const;
};

}  // namespace radiosity
