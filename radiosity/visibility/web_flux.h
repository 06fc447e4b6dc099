#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/photometric_web.h"

namespace radiosity {

/// The light of a photometric web through polygons as its point sees them, without sampling of the
/// solid angle. With the polar angle θ, the azimuth φ and J(θ, φ) = ∫_0^θ I sin θ' dθ', which is
/// known in closed form,
///     Φ = ∫ I dΩ = ∮ J dφ
/// along the polygon's border (Green). Borders are great circles, divided where they cross lines of
/// the web's grid, near the pole, and integrated piece by piece by Gauss's rule. An edge that two
/// polygons share gives and takes the same, so that polygons all around have the flux of the web.
/// Immutable; may be used by many threads.
class WebFlux {
 public:
  explicit WebFlux(const PhotometricWeb& web);

  /// Flux through a planar convex polygon, lm. Corners are relative to the point, in the
  /// luminaire's frame, and run counter-clockwise as the point sees them; the point is not in its
  /// plane.
  [[nodiscard]] double through(std::span<const Vec3> polygon) const;

 private:
  /// The web about one of its two poles.
  struct Table {
    PolarAxes axes;
    double sense;  ///< 1 or -1: of azimuths as the point sees them
    std::vector<double> polar;
    std::vector<double> azimuth;
    Eigen::MatrixXd intensity;
    Eigen::MatrixXd below;  ///< J at the nodes, cd

    [[nodiscard]] double below_polar(double polar_angle, Index column) const;
    /// J at a direction, cd.
    [[nodiscard]] double integral(double polar_angle, double azimuth_angle) const;
  };
  struct Arc;
  static Table make_table(const PhotometricWeb& web, bool is_turned);
  static void divide(const Table& table, const Arc& arc, std::vector<double>& places);
  static double along(const Table& table, const Vec3& from, const Vec3& to);

  Table near_pole_;  ///< from the pole
  Table far_pole_;   ///< from the opposite one
};

}  // namespace radiosity
