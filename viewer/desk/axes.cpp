#include "viewer/desk/axes.h"

#include <algorithm>

namespace viewer {

using radiosity::Vec3;

std::array<ShownAxis, 3> shown_axes(const radiosity::Camera& camera) {
  const Vec3 right = camera.direction.cross(camera.up).normalized();
  const Vec3 up = right.cross(camera.direction);
  std::array<ShownAxis, 3> axes;
  for (int k = 0; k < 3; ++k) {
    axes[k] = {.name = static_cast<char>('x' + k),
               .right = right[k],
               .up = up[k],
               .nearness = -camera.direction[k]};
  }
  std::stable_sort(axes.begin(), axes.end(),
                   [](const ShownAxis& a, const ShownAxis& b) { return a.nearness < b.nearness; });
  return axes;
}

}  // namespace viewer
