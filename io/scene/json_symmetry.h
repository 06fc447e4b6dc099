#pragma once

#include "io/base/json_item.h"
#include "radiosity/scene/symmetry.h"

namespace io {

/// Reads a `symmetry`: mirror planes, a rotation, translations with their cut-off. Lengths are in
/// units of `unit` metres. Throws SceneError naming the item if something is missing or makes no
/// sense, and as radiosity::image_motions does.
radiosity::Symmetry read_symmetry(const JsonItem& item, double unit);

}  // namespace io
