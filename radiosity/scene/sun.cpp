#include "radiosity/scene/sun.h"

#include <cmath>

namespace radiosity {
namespace {

/// Below this sine of the angle between +y and `up` there is no telling where north is by +y.
constexpr double kUpright = 1e-6;

Vec3 horizontal(const Vec3& direction, const Vec3& up) {
  return direction - up.dot(direction) * up;
}

}  // namespace

Vec3 sun_direction(double azimuth, double elevation, const Vec3& up, const Vec3& north) {
  const Vec3 ahead = horizontal(north, up).normalized();
  const Vec3 east = ahead.cross(up);
  const Vec3 towards =
      std::cos(elevation) * (std::cos(azimuth) * ahead + std::sin(azimuth) * east) +
      std::sin(elevation) * up;
  return -towards.normalized();
}

Vec3 usual_north(const Vec3& up) {
  const Vec3 north = horizontal(Vec3(0, 1, 0), up);
  if (north.norm() > kUpright) return north.normalized();
  return horizontal(Vec3(0, 0, up.y() > 0 ? -1 : 1), up).normalized();
}

}  // namespace radiosity
