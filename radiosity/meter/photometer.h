#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "radiosity/picture/final_gather.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"
#include "radiosity/visibility/incident_light.h"

namespace radiosity {

/// Columns of what is measured of one light.
enum class LightPart {
  direct,    ///< straight from lamps and sun
  indirect,  ///< reflected
  error      ///< one standard error of both together, at most
};
inline constexpr Index kLightParts = 3;

/// A light in a scene: that of new lamps, say.
struct Lighting {
  const Scene& scene;  ///< whose sun and sky it is
  const Solution& solution;
};

/// Measures illuminance at points, by the final gather with exact shadows, of several lights in one
/// scene at once. Results have kLightParts columns for each light, one light after the other, lux.
/// The error adds up the patches' own, as if all were off to the same side, and what the gather of
/// many points interpolates. Immutable; for many threads.
class Photometer {
 public:
  /// `weights` make lux of the bands (luminous_weights). Mesh and scenes must outlive this.
  Photometer(const PatchMesh& mesh, std::span<const Lighting> lights,
             const Eigen::VectorXd& weights);

  [[nodiscard]] Index n_columns() const { return columns_; }
  [[nodiscard]] const FinalGather& gather() const { return gather_; }

  /// What comes from sun and other sources that are no patches is added to irradiance from patches,
  /// n_columns, of a plane that faces `normal`.
  void add_incident(const Vec3& point, const Vec3& normal,
                    Eigen::Ref<Eigen::RowVectorXd> light) const;

  /// All that can be measured of a point's surroundings at once.
  struct Around {
    Eigen::MatrixXd planes;          ///< of planes that face `directions`, n x n_columns
    Eigen::RowVectorXd cylinder;     ///< E_z = 1/π ∫ L sinθ dω about `up`
    Eigen::MatrixXd half_cylinders;  ///< E_sz = 1/π ∫ L (1 + cosα) sinθ dω (EN 13201-3)
  };
  /// `up` is of unit length. The half cylinders face `halves`, horizontal, unit: they have E_z and
  /// 1/π of the difference between both sides of a plane. A point on a patch that faces up
  /// (`is_on_patch`) sees nothing below. Closed forms of what is seen but for light from no patch
  /// on cylinders: that is the mean over kAzimuths vertical planes.
  [[nodiscard]] Around around(const Vec3& point, const Vec3& up, bool is_on_patch,
                              std::span<const Vec3> directions, std::span<const Vec3> halves) const;

  /// Directions about a cylinder; of a beam from one side the mean of max(0, cos) over as many is
  /// off by Σ_m 2 / (m² n²) = π² / (3 n²) of it at most, what its Fourier series has beyond.
  static constexpr int kAzimuths = 180;

  /// The luminous exitance of patches, n_patches x n_columns, lx.
  [[nodiscard]] const Eigen::MatrixXd& exitance() const { return exitance_; }

 private:
  Photometer(const PatchMesh& mesh, std::span<const Lighting> lights,
             const Eigen::VectorXd& weights, Eigen::MatrixXd exitance);

  Eigen::MatrixXd exitance_;
  Index columns_;
  FinalGather gather_;
  Eigen::VectorXd weights_;
  std::vector<IncidentLight> incident_;
};

}  // namespace radiosity
