#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/scene/luminous_opening.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/incident_irradiance.h"
#include "radiosity/visibility/opening_light.h"
#include "radiosity/visibility/point_shadows.h"
#include "radiosity/visibility/web_flux.h"

namespace radiosity {

/// Light straight from the luminaires of a scene, of a photometric web each: points, or openings of
/// some extent, over which it is integrated (LuminousOpening). One that a surface cuts through
/// counts as a point. Immutable; may be used by many threads.
class LuminaireLight {
 public:
  /// The mesh must outlive this.
  LuminaireLight(const Scene& scene, const PatchMesh& mesh);

  /// Adds the irradiance I cosθ / d² at a point (m) of a surface with that unit normal from what it
  /// sees of the luminaires, W/m², n_bands; of openings its mean over the part that is seen, whose
  /// outline is exact, by quadrature to 1e-5. Returns what that may be off, of the brightest band.
  double add(const Vec3& point, const Vec3& normal, Eigen::Ref<Eigen::VectorXd> irradiance) const;

  /// The mean of that on each patch, W/m², n_patches x n_bands: the flux of the web through the
  /// patch without its shadows (WebFlux, PointShadows) over its area; of openings its mean over
  /// their points, to 2e-3 or 5e-4 of all luminaires' flux over the area of all patches. What
  /// solids cover gets nothing, of luminaires within them neither. Same bits at any number of
  /// threads. Throws Interrupted.
  [[nodiscard]] IncidentIrradiance irradiance(const Progress& progress = {}) const;

  /// The same apart for groups of luminaires: `group` tells that of each luminaire of the scene, 0
  /// to n_groups - 1. Their sum is `irradiance` but for rounding.
  [[nodiscard]] std::vector<IncidentIrradiance> irradiance_of_groups(
      const std::vector<int>& group, Index n_groups, const Progress& progress = {}) const;

  /// The luminaires of the scene whose opening a surface cuts through, so that they count as
  /// points.
  [[nodiscard]] const std::vector<std::size_t>& cut_openings() const { return cut_openings_; }

 private:
  struct Source {
    PointLight light;
    Eigen::Matrix3d axes;
    int photometry;
    Eigen::VectorXd watts_per_lumen;  // with all factors
    std::size_t luminaire;            // of the scene
    std::optional<LuminousOpening> opening;
    double undimmed;  // W for each lumen of the web
  };
  [[nodiscard]] bool is_cut(const LuminousOpening& opening) const;
  [[nodiscard]] OpeningMean at_point(const Source& source, const Vec3& point,
                                     const Vec3& normal) const;
  [[nodiscard]] double flux_through(const Source& source, const Vec3& from, Index patch,
                                    ShadowCutter& cutter) const;
  [[nodiscard]] OpeningMean on_patch(const Source& source, Index patch, ShadowCutter& cutter) const;
  const PatchMesh& mesh_;
  PointShadows shadows_;
  std::vector<PhotometricWeb> webs_;
  std::vector<WebFlux> fluxes_;
  std::vector<Source> sources_;
  std::vector<std::size_t> cut_openings_;
  double even_light_ = 0;  // what is negligible of one luminaire, W/m²
  Index n_bands_;
};

}  // namespace radiosity
