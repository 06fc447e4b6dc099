#pragma once

#include "io/base/json_item.h"
#include "radiosity/base/geometry.h"

namespace io {

/// A point or a vector as scenes have it: [x, y, z].
inline Json point_json(const radiosity::Vec3& x) { return {x.x(), x.y(), x.z()}; }

}  // namespace io
