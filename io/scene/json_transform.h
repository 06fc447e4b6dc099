#pragma once

#include <Eigen/Geometry>

#include "io/base/json_item.h"

namespace io {

/// Reads a `transform`: a 4x4 `matrix` (rows), or first `scale`, then `rotate`, then `translate`.
/// The translation is in the scene's unit. Throws SceneError naming the item if it flattens space
/// or is not affine.
Eigen::Affine3d read_transform(const JsonItem& item);

}  // namespace io
