#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/meter/grid_light.h"
#include "radiosity/meter/photometer.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Measures what an eye sees: the luminance of surfaces, cd/m², of several lights in one scene, in
/// columns as a Photometer has them. What a diffuse surface sends is (M_e + ρ E) / π, with the
/// illuminance E gathered anew where it is seen, with exact shadows, band by band. Immutable; for
/// many threads.
class LuminanceMeter {
 public:
  /// As a Photometer. Scenes, mesh and visibility must outlive this.
  LuminanceMeter(const PatchMesh& mesh, const Visibility& visibility,
                 std::span<const Lighting> lights, const Eigen::VectorXd& weights);

  /// What is seen in the direction of a point from an eye, m: of the first surface in the way,
  /// beyond the point, too. LightPart::direct is what it emits and what it reflects of light that
  /// comes straight from lamps, sun and sky. 0 where there is no surface, and of backs that emit
  /// nothing. The eye must not be in the point.
  [[nodiscard]] Eigen::RowVectorXd seen(const Vec3& eye, const Vec3& point) const;

 private:
  struct Light {
    Eigen::MatrixXd exitance;     // luminous, lm/m² of each band, n_patches x n_bands
    Eigen::MatrixXd reflectance;  // likewise
    IncidentLight incident;
  };
  const PatchMesh& mesh_;
  const Visibility& visibility_;
  Eigen::VectorXd weights_;
  std::vector<Light> lights_;
  FinalGather gather_;  // of each light emitted, reflected and error, band by band
};

/// What the eyes of a plan see in the direction of its open points, cd/m², a quantity for each.
/// Reports "luminances"; throws SceneError naming the grid for an eye in a point, and Interrupted.
std::vector<GridQuantity> measure_luminance(const GridPlan& plan, const GridLight& light,
                                            const LuminanceMeter& meter,
                                            const Progress& progress = {});

}  // namespace radiosity
