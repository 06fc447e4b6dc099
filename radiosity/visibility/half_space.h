#pragma once

#include "radiosity/base/geometry.h"

namespace radiosity {

/// The oriented plane normal · x = offset; outside is normal · x > offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

}  // namespace radiosity
