#pragma once

#include <filesystem>

#include "radiosity/scene/photometry.h"

namespace io {

/// Writes the polar curve of a luminaire as SVG that needs nothing else: intensity in cd over the
/// angle to its axis, in the planes C0-C180 (solid) and C90-C270 (dashed; not if it is rotational).
/// Throws OutputError.
void write_polar_curve(const std::filesystem::path& path, const radiosity::Photometry& photometry);

}  // namespace io
