#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/meter/glare.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/point_shadows.h"

namespace radiosity {

/// The area of a luminaire's luminous opening as seen from a direction (unit, in its frame), m²: a
/// flat or standing rectangle or ellipse, with its sides.
double projected_opening(const Photometry& photometry, const Vec3& direction);

/// Luminaires of photometric files as sources of glare (CIE 117): of the luminance I / A_p and the
/// solid angle A_p / d² of the opening's projected area A_p, d being the distance of its middle. Of
/// those that stand for its opening by several points the share that the eye sees.
class LuminaireGlare {
 public:
  /// `weights` make cd of the bands (luminous_weights). Scene and mesh must outlive this.
  LuminaireGlare(const Scene& scene, const PatchMesh& mesh, const Eigen::VectorXd& weights);

  /// Those that the observer sees in front, by their names, but for such without an opening.
  [[nodiscard]] std::vector<GlareSource> sources(const Observer& observer) const;

  /// Luminaires that shine but have no opening.
  [[nodiscard]] Index n_without_opening() const;

 private:
  const Scene& scene_;
  PointShadows shadows_;
  Eigen::VectorXd weights_;
};

}  // namespace radiosity
