#pragma once

#include <cstdint>

#include "radiosity/base/geometry.h"
#include "tests/support/scene_families.h"

namespace radiosity::test {

/// How coordinates are written.
enum class Digits : std::uint8_t {
  all,    ///< 17 decimal digits
  six,    ///< 6, as "%.6g" does
  single  ///< float32
};

/// The same scene, given in another way.
struct Variation {
  bool is_turned = false;
  double scale = 1;
  Vec3 shift = Vec3::Zero();  ///< m, after scaling
  Digits digits = Digits::all;
  bool is_shuffled = false;    ///< polygons in another order, starting at another corner
  bool is_triangular = false;  ///< quads as two triangles
  std::uint64_t seed = 0;      ///< of the rotation and the order
};

/// One of any kind. Coordinates far from the origin keep all digits: fewer would spoil the shape.
Variation random_variation(std::uint64_t seed);

/// The scene varied. Surfaces keep their order.
FamilyScene vary(const FamilyScene& original, const Variation& variation);

}  // namespace radiosity::test
