#pragma once

#include <array>

#include "io/picture/rgb_picture.h"
#include "radiosity/base/geometry.h"

namespace viewer {

/// A line on the surfaces of a scene, to be drawn over them.
struct SurfaceLine {
  std::array<radiosity::Vec3, 2> ends;     ///< m
  std::array<radiosity::Vec3, 2> normals;  ///< of the surfaces at either side, unit; may be one
  /// Whether it is to be seen on either surface; else only where one hides the other.
  bool is_sharp = true;
  io::Rgb color = {};  ///< 8-bit sRGB
};

/// Whether backs of surfaces are drawn.
enum class Backs { hidden, shown };

/// Whether a camera at `position` sees it, if nothing is in between.
bool is_drawn(const SurfaceLine& line, const radiosity::Vec3& position, Backs backs);

/// Its ends nearer to the camera by what the surfaces it lies on recede within a pixel, whose width
/// is `pixel` at unit distance: else these would hide it where they slope.
std::array<radiosity::Vec3, 2> raised_ends(const SurfaceLine& line, const radiosity::Vec3& position,
                                           double pixel);

}  // namespace viewer
