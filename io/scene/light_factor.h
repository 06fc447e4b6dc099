#pragma once

#include "io/base/json_item.h"

namespace io {

/// Of what a surface emits: "on" (1), "off" (0) or a factor of at least 0 of the power. Throws
/// SceneError naming the item.
double read_light_factor(const JsonItem& item);

}  // namespace io
