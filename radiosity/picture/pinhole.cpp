#include "radiosity/picture/pinhole.h"

#include <cmath>

namespace radiosity {

Pinhole::Pinhole(const Camera& camera, int width, int height)
    : position_(camera.position),
      forward_(camera.direction.normalized()),
      right_(forward_.cross(camera.up).normalized()),
      down_(forward_.cross(right_)),
      pixel_(2 * std::tan(camera.vertical_fov / 2) / height),
      center_(0.5 * width, 0.5 * height) {}

}  // namespace radiosity
