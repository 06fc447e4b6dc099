#pragma once

#include <Eigen/Core>
#include <optional>

#include "radiosity/base/geometry.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/incident_light.h"
#include "study/projected_area.h"
#include "study/study.h"

namespace study {

/// What the body of a person gets of radiation.
struct BodyRadiation {
  double irradiance = 0;     ///< mean over its effective area, but for surroundings, W/m²
  Eigen::VectorXd surfaces;  ///< form factors to each surface's emitting side; with the rest 1
  double backs = 0;          ///< to the backs of one-sided surfaces
  double sky = 0;            ///< to where there is no surface
};

/// A body of given projected areas anywhere in a solved scene. Immutable; may be used by many
/// threads.
class SeenBody {
 public:
  /// `bands` are the weights of the solution's bands; the study must outlive this.
  SeenBody(const Study& solved, const Eigen::VectorXd& bands, ProjectedArea area,
           const radiosity::Vec3& up);

  /// What is seen from the point is cut out exactly; over it f_p is integrated to 1e-4 of all.
  [[nodiscard]] BodyRadiation at(const radiosity::Vec3& point) const;

 private:
  [[nodiscard]] double total_area() const;

  radiosity::PatchMesh mesh_;  // with the backs of one-sided patches as a surface of its own
  Eigen::VectorXd radiosity_;  // of its patches, weighted, W/m²
  radiosity::FinalGather seen_;
  ProjectedArea area_;
  radiosity::Vec3 up_;
  double total_;  // ∫ f_p dω, about π
  Eigen::VectorXd bands_;
  std::optional<radiosity::Vec3> to_sun_;
  radiosity::IncidentLight sun_;
};

}  // namespace study
