#include "viewer/desk/camera_control.h"

#include <algorithm>
#include <cmath>

namespace viewer {

using radiosity::Vec3;

CameraControl::CameraControl(const radiosity::Camera& camera, const radiosity::Box3& bounds)
    : camera_(camera) {
  camera_.direction.normalize();
  camera_.up.normalize();
  const double size = bounds.isEmpty() ? 1.0 : bounds.diagonal().norm();
  const Vec3 center = bounds.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(bounds.center());
  const double ahead = (center - camera_.position).dot(camera_.direction);
  distance_ = ahead > 0.1 * size ? ahead : 0.5 * size;
  least_distance_ = 1e-4 * size;
}

Vec3 CameraControl::right_direction() const {
  const Vec3 right = camera_.direction.cross(camera_.up);
  return right.norm() > 0 ? Vec3(right.normalized()) : camera_.direction.unitOrthogonal();
}

Eigen::Matrix3d CameraControl::turn(double right, double up) {
  constexpr double kClosest = 0.01;  // to the up direction, radian
  const double angle = std::acos(std::clamp(camera_.direction.dot(camera_.up), -1.0, 1.0));
  const double raised = std::clamp(angle - up, kClosest, radiosity::kPi - kClosest);
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(-right, camera_.up) * Eigen::AngleAxisd(angle - raised, right_direction()))
          .toRotationMatrix();
  camera_.direction = (rotation * camera_.direction).normalized();
  return rotation;
}

void CameraControl::orbit(double right, double up) {
  const Vec3 center = pivot();
  turn(right, up);
  camera_.position = center - distance_ * camera_.direction;
}

void CameraControl::orbit_about(const Vec3& center, double right, double up) {
  const Vec3 offset = camera_.position - center;
  camera_.position = center + turn(right, up) * offset;
}

void CameraControl::look_around(double right, double up) { turn(right, up); }

void CameraControl::pan(double right, double up) {
  const double height = 2 * distance_ * std::tan(camera_.vertical_fov / 2);
  const Vec3 sideways = right_direction();
  const Vec3 upwards = sideways.cross(camera_.direction);
  camera_.position += height * (right * sideways + up * upwards);
}

void CameraControl::zoom(double factor) {
  const Vec3 center = pivot();
  distance_ = std::max(least_distance_, distance_ * factor);
  camera_.position = center - distance_ * camera_.direction;
}

void CameraControl::zoom_to(const Vec3& point, double factor) {
  const Vec3 offset = camera_.position - point;
  const double distance = std::max(offset.norm(), least_distance_);
  const double shrink = std::max(factor, least_distance_ / distance);
  camera_.position = point + shrink * offset;
  distance_ = std::max(least_distance_, shrink * distance_);
}

void CameraControl::fly(double forward, double right, double up) {
  camera_.position += forward * camera_.direction + right * right_direction() + up * camera_.up;
}

void CameraControl::focus(const Vec3& point) {
  const double ahead = (point - camera_.position).dot(camera_.direction);
  distance_ = std::max(least_distance_, ahead);
}

Vec3 ray_direction(const radiosity::Camera& camera, double x, double y, double aspect) {
  const double half = std::tan(camera.vertical_fov / 2);
  const Vec3 right = camera.direction.cross(camera.up).normalized();
  const Vec3 up = right.cross(camera.direction);
  return (camera.direction + half * aspect * (2 * x - 1) * right + half * (1 - 2 * y) * up)
      .normalized();
}

}  // namespace viewer
