#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/point_shadows.h"
#include "radiosity/visibility/web_flux.h"

namespace radiosity {

/// Light straight from the luminaires of a scene, each a point with a photometric web. Immutable;
/// may be used by many threads.
class LuminaireLight {
 public:
  /// The mesh must outlive this.
  LuminaireLight(const Scene& scene, const PatchMesh& mesh);

  /// Adds the irradiance I cosθ / d² at a point (m) of a surface with that unit normal from the
  /// luminaires that reach it, W/m², n_bands.
  void add(const Vec3& point, const Vec3& normal, Eigen::Ref<Eigen::VectorXd> irradiance) const;

  /// The mean of that on each patch, W/m², n_patches x n_bands: the flux of the web through the
  /// patch without its shadows (WebFlux, PointShadows) over its area. Same bits at any number of
  /// threads. Throws Interrupted.
  [[nodiscard]] Eigen::MatrixXd irradiance(const Progress& progress = {}) const;

  /// The same apart for groups of luminaires: `group` tells that of each luminaire of the scene, 0
  /// to n_groups - 1. Their sum is `irradiance` but for rounding.
  [[nodiscard]] std::vector<Eigen::MatrixXd> irradiance_of_groups(
      const std::vector<int>& group, Index n_groups, const Progress& progress = {}) const;

 private:
  struct Source {
    PointLight light;
    Eigen::Matrix3d axes;
    int photometry;
    Eigen::VectorXd watts_per_lumen;  // with all factors
    std::size_t luminaire;            // of the scene
  };
  const PatchMesh& mesh_;
  PointShadows shadows_;
  std::vector<PhotometricWeb> webs_;
  std::vector<WebFlux> fluxes_;
  std::vector<Source> sources_;
  Index n_bands_;
};

}  // namespace radiosity
