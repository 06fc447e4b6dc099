#include "radiosity/visibility/blocker.h"

#include <algorithm>
#include <cmath>

namespace radiosity {

void set_sphere(Blocker& blocker) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : blocker.corners) sum += corner;
  blocker.center = sum / static_cast<double>(std::max<std::size_t>(1, blocker.corners.size()));
  double square = 0;
  for (const Vec3& corner : blocker.corners) {
    square = std::max(square, (corner - blocker.center).squaredNorm());
  }
  blocker.radius = std::sqrt(square);
}

}  // namespace radiosity
