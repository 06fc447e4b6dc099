#include "radiosity/scene/luminaire.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace radiosity {
namespace {

/// Sine of the angle to `up` below which a direction counts as straight up or down.
constexpr double kVertical = 1e-9;
/// A unit vector that is normal to another one but for rounding is kept as it is, so that what was
/// written reads back the same.
constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

Eigen::Matrix3d aimed_axes(const Vec3& direction, const Vec3& c0) {
  const Vec3 z = -direction;
  const bool is_kept = std::abs(z.dot(c0)) < kRounding && std::abs(c0.norm() - 1) < kRounding;
  const Vec3 x = is_kept ? c0 : (c0 - z.dot(c0) * z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

Eigen::Matrix3d aimed_axes(const Vec3& direction, double turn, const Vec3& up, const Vec3& east) {
  const Vec3 right = direction.cross(up);
  const Eigen::Matrix3d axes = aimed_axes(direction, right.norm() > kVertical ? right : east);
  return axes * Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
}

}  // namespace radiosity
