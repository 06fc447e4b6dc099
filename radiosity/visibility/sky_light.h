#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/polygon/spherical_integral.h"
#include "radiosity/scene/glazing.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visible_sky.h"

namespace radiosity {

/// E_h / L_z on an unobstructed horizontal surface: ∫ L/L_z cosZ dω over the sky, to 1e-8 of it.
double horizontal_ratio(const Sky& sky);

/// E_h of the sky alone, without the sun, W/m² per band.
Eigen::VectorXd horizontal_irradiance(const Sky& sky);

/// Radiance of the ground per band, W/(m² sr): ρ (E_h + E_n sin h) / π, with the scene's sun.
Eigen::VectorXd ground_radiance(const Sky& sky, const std::optional<Sun>& sun);

/// What comes from the sky and from the ground, W/m² per band.
struct SkyIrradiance {
  Eigen::VectorXd sky;
  Eigen::VectorXd ground;
  double error = 0;  ///< a bound on what quadrature left of the sum, of the brightest band

  [[nodiscard]] Eigen::VectorXd sum() const { return sky + ground; }
};

/// The same on patches, n x b, with the error of each, n.
struct PatchSkyIrradiance {
  Eigen::MatrixXd irradiance;
  Eigen::VectorXd error;
};

/// Light of a scene's sky and its ground that surfaces get straight from there: E = ∫ L cosθ dω
/// over the directions in which they see no surface (VisibleSky), through panes times what these
/// let through. Uniform parts in closed form (Lambert 1760), the others by quadrature to 1e-6 of
/// what an open sky gives. Immutable; may be used by many threads.
class SkyLight {
 public:
  /// Scene::sky must be there. The mesh must outlive this.
  SkyLight(const Scene& scene, const PatchMesh& mesh);

  /// At a point (m) of a surface with that unit normal.
  [[nodiscard]] SkyIrradiance at(const Vec3& point, const Vec3& normal) const;

  /// Means over the patches, by Gauss rules on each, which is divided in four until two of them
  /// differ by a thousandth, or by 1e-5 of E_h, twice at most. Throws Interrupted.
  [[nodiscard]] PatchSkyIrradiance on_patches(const Progress& progress = {}) const;

 private:
  struct Mean;
  [[nodiscard]] Mean mean_on(Index patch) const;
  [[nodiscard]] double shared_factor(std::span<const VisibleSky::Pane> panes, const Vec3& direction,
                                     Index band) const;
  void add_part(const ConvexPolygon& part, std::span<const VisibleSky::Pane> panes,
                const Vec3& normal, SkyIrradiance& sum) const;

  const PatchMesh& mesh_;
  Sky sky_;
  double value_at_zenith_;
  double horizontal_;              // E_h / L_z
  Eigen::VectorXd ground_;         // radiance
  std::vector<Glazing> glazings_;  // by kind of pane
  std::vector<ConvexPolygon> cells_;
  VisibleSky visible_;
};

}  // namespace radiosity
