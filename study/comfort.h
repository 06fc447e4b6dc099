#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "study/posture.h"
#include "study/study.h"

namespace study {

/// How a person's body takes up radiation.
enum class BodyModel {
  six_planes,     ///< by plane radiant temperatures in six directions (ISO 7726)
  projected_area  ///< by Fanger's projected area factor for each direction (ProjectedArea)
};

/// "six-planes" or "projected-area"; empty if the text is neither.
std::optional<BodyModel> body_model_named(std::string_view name);

struct ComfortOptions {
  Posture posture = Posture::standing;
  BodyModel body = BodyModel::six_planes;
  radiosity::Vec3 up = radiosity::Vec3(0, 0, 1);  ///< unit
  /// Where the person looks to, any vector that is not along `up`; absent: turned to all sides
  /// alike.
  std::optional<radiosity::Vec3> facing = {};
  radiosity::Progress progress = {};
};

/// What a person at a point gets of thermal radiation.
struct ComfortPoint {
  radiosity::Vec3 position;         ///< m
  double mean_radiant_temperature;  ///< K
  /// Plane radiant temperatures of small planes that look up, down, to the front, back, left and
  /// right, K; those of a person turned to all sides look along two axes of the horizontal plane.
  std::array<double, 6> plane_temperatures;
  Eigen::VectorXd surfaces;  ///< form factors from the person to each surface's emitting side
  double backs = 0;          ///< to the backs of one-sided surfaces
  double sky = 0;            ///< to where there is no surface
};

/// Throws SceneError if the scene's light is no heat, the person's facing is along `up`, or a sky
/// or luminaires shine on a body of projected areas.
void check_comfort(const radiosity::Scene& scene, const ComfortOptions& options);

/// The mean radiant temperature at points: of six planes with the irradiances H_k, σ T_k⁴ = H_k is
/// the plane radiant temperature, and σ T⁴ = Σ w_k H_k / Σ w_k with the projected area factors w of
/// a standing or seated person, up and down 0.08 or 0.18, left and right 0.23 or 0.22, front and
/// back 0.35 or 0.30 (ISO 7726:1998, annex B, where the temperatures themselves are averaged, which
/// is nearly the same). Of projected areas, σ T⁴ = ∫ f_p π L dω / ∫ f_p dω over all directions with
/// the radiance L from there, and f_p E_n / ∫ f_p dω · π of a sun (Fanger 1970), to 1e-4 of it;
/// form factors are ∫ f_p dω over what is seen of a surface, of that over all. Irradiances are
/// exact for radiosity that is constant on each patch; the environment counts by what is seen of
/// it, of a sun's own band nothing. Throws SceneError as `check_comfort` does; Interrupted.
std::vector<ComfortPoint> comfort(const Study& solved, std::span<const radiosity::Vec3> points,
                                  const ComfortOptions& options = {});

}  // namespace study
