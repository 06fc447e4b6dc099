#pragma once

#include <optional>

#include "radiosity/base/geometry.h"
#include "study/posture.h"

namespace study {

/// Fanger's projected area factors of a person: f_p(ω), the area that a standing or seated body
/// shows to a direction, of its effective radiation area. Measured at every 15° of altitude and
/// azimuth (Fanger, Thermal Comfort, 1970, tables 3 and 4, as ANSI/ASHRAE 55 prints them), bilinear
/// between. From below a body shows what it does from the opposite direction.
class ProjectedArea {
 public:
  /// `up` and `facing` are unit vectors at a right angle; without `facing` the person is turned to
  /// all sides alike, and f_p is the mean over the azimuth.
  ProjectedArea(Posture posture, const radiosity::Vec3& up,
                const std::optional<radiosity::Vec3>& facing);

  /// f_p for a unit vector that points from the person.
  [[nodiscard]] double operator()(const radiosity::Vec3& direction) const;

 private:
  Posture posture_;
  radiosity::Vec3 up_;
  std::optional<radiosity::Vec3> facing_;
};

}  // namespace study
