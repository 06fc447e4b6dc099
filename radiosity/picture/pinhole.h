#pragma once

#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// The directions in which a camera sees the places of a picture.
class Pinhole {
 public:
  Pinhole(const Camera& camera, int width, int height);

  [[nodiscard]] const Vec3& position() const { return position_; }
  /// Through a place of the picture, pixels from its upper left corner. Unit length.
  [[nodiscard]] Vec3 direction(double x, double y) const {
    const double across = x - center_[0];
    const double along = y - center_[1];
    return (forward_ + pixel_ * (across * right_ + along * down_)).normalized();
  }
  /// How large a pixel is at a distance in a direction of unit length, m.
  [[nodiscard]] double pixel_size(const Vec3& direction, double distance) const {
    return pixel_ * distance * direction.dot(forward_);
  }

 private:
  Vec3 position_;
  Vec3 forward_;
  Vec3 right_;
  Vec3 down_;
  double pixel_;  // width of one, at unit distance
  Eigen::Vector2d center_;
};

}  // namespace radiosity
