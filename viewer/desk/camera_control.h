#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace viewer {

/// Moves a camera as a hand on the mouse means it. Pure geometry. Angles in radian, positive to the
/// right and up; shifts relative to the height of the picture.
class CameraControl {
 public:
  CameraControl() = default;
  /// Begins with `camera` in a scene within `bounds`, and turns about the scene's centre or, if
  /// that lies behind, about a point ahead.
  CameraControl(const radiosity::Camera& camera, const radiosity::Box3& bounds);

  [[nodiscard]] const radiosity::Camera& camera() const { return camera_; }
  /// The point that `orbit` turns about.
  [[nodiscard]] radiosity::Vec3 pivot() const {
    return camera_.position + distance_ * camera_.direction;
  }

  /// Turns the camera about the pivot; stops short of looking along `up`.
  void orbit(double right, double up);
  /// The same about any point, which stays at its place in the picture.
  void orbit_about(const radiosity::Vec3& center, double right, double up);
  /// Turns the camera where it stands.
  void look_around(double right, double up);
  /// Moves the camera in the picture's plane, so that the pivot follows the mouse.
  void pan(double right, double up);
  /// Goes towards the pivot: to `factor` (> 0) times the distance.
  void zoom(double factor);
  /// Goes towards a point, which stays at its place in the picture: to `factor` (> 0) times the
  /// distance.
  void zoom_to(const radiosity::Vec3& point, double factor);
  /// Moves the camera by metres along its own directions.
  void fly(double forward, double right, double up);
  /// Makes a point of the scene the pivot.
  void focus(const radiosity::Vec3& point);

 private:
  /// Returns the rotation.
  Eigen::Matrix3d turn(double right, double up);
  [[nodiscard]] radiosity::Vec3 right_direction() const;

  radiosity::Camera camera_;
  double distance_ = 1;  // of the pivot, m
  double least_distance_ = 1e-6;
};

/// Direction of the ray through a point of the picture, unit length: x and y in [0, 1] from the top
/// left, aspect = width / height.
radiosity::Vec3 ray_direction(const radiosity::Camera& camera, double x, double y, double aspect);

}  // namespace viewer
