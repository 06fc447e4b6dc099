#include "viewer/desk/surface_line.h"

namespace viewer {

bool is_drawn(const SurfaceLine& line, const radiosity::Vec3& position, Backs backs) {
  const radiosity::Vec3 towards = position - 0.5 * (line.ends[0] + line.ends[1]);
  const bool is_first_front = line.normals[0].dot(towards) > 0;
  const bool is_second_front = line.normals[1].dot(towards) > 0;
  if (!line.is_sharp && is_first_front == is_second_front) return false;
  return backs == Backs::shown || is_first_front || is_second_front;
}

}  // namespace viewer
