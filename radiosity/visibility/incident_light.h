#pragma once

#include <Eigen/Core>
#include <memory>

#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/incident_irradiance.h"

namespace radiosity {

/// Light that comes straight from what is no surface of the scene, with exact shadows: the sun, E =
/// E_n cosθ where it shines (SunShadows), the sky with its ground (SkyLight), and luminaires, E = I
/// cosθ / d² (LuminaireLight). Copies share what they hold; immutable, and may be used by many
/// threads.
class IncidentLight {
 public:
  /// Of nothing: dark.
  IncidentLight() = default;
  /// Of all such sources of a scene. The mesh must outlive this.
  IncidentLight(const Scene& scene, const PatchMesh& mesh);

  /// Adds the irradiance at a point (m) of a surface with that unit normal, W/m², n_bands. Returns
  /// what quadrature may have left of it, W/m² of the brightest band.
  double add(const Vec3& point, const Vec3& normal, Eigen::Ref<Eigen::VectorXd> irradiance) const;

 private:
  struct Sources;
  std::shared_ptr<const Sources> sources_;
};

/// The share of each patch's area that parallel light in a direction of unit length reaches,
/// n_patches, in [0, 1], by exact shadows: SunShadows::lit_shares. Throws Interrupted.
Eigen::VectorXd lit_shares(const PatchMesh& mesh, const Vec3& direction,
                           const Progress& progress = {});

/// Whether a scene has any such source.
bool has_incident_light(const Scene& scene);

/// The mean of IncidentLight on each patch, n_patches x n_bands, W/m², of the sun exactly: E = E_n
/// cosθ · lit share, of luminaires too: the flux through the lit parts over the area; of the sky by
/// SkyLight::on_patches. Empty if the scene has no such source. (1 - ρ) E is what the patch absorbs
/// of it before any reflection. Throws Interrupted, and SolveError for a scene with a symmetry.
Eigen::MatrixXd incident_irradiance(const Scene& scene, const PatchMesh& mesh,
                                    const Progress& progress = {});

/// The same with what it may be off.
IncidentIrradiance incident_on_patches(const Scene& scene, const PatchMesh& mesh,
                                       const Progress& progress = {});

/// What leaves each patch before light is exchanged, |M_e| + ρ E, n_patches x n_bands, W/m², as far
/// as it is known without form factors: the light that operators are made for. Heat that is taken
/// away counts like heat given.
Eigen::MatrixXd initial_radiosity(const Scene& scene, const PatchMesh& mesh,
                                  const Progress& progress = {});

}  // namespace radiosity
