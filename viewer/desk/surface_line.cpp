#include "viewer/desk/surface_line.h"

#include <algorithm>
#include <cmath>

namespace viewer {

bool is_drawn(const SurfaceLine& line, const radiosity::Vec3& position, Backs backs) {
  const radiosity::Vec3 towards = position - 0.5 * (line.ends[0] + line.ends[1]);
  const bool is_first_front = line.normals[0].dot(towards) > 0;
  const bool is_second_front = line.normals[1].dot(towards) > 0;
  if (!line.is_sharp && is_first_front == is_second_front) return false;
  return backs == Backs::shown || is_first_front || is_second_front;
}

std::array<radiosity::Vec3, 2> raised_ends(const SurfaceLine& line, const radiosity::Vec3& position,
                                           double pixel) {
  constexpr double kMostRaised = 0.01;  // of the distance
  std::array<radiosity::Vec3, 2> ends = line.ends;
  for (radiosity::Vec3& end : ends) {
    const radiosity::Vec3 towards = position - end;
    const double distance = towards.norm();
    double slope = 0;
    for (const radiosity::Vec3& normal : line.normals) {
      const double cosine = normal.dot(towards) / distance;
      if (cosine > 0)
        slope = std::max(slope, std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine);
    }
    end += std::min(pixel * slope, kMostRaised) * towards;
  }
  return ends;
}

}  // namespace viewer
