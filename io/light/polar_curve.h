#pragma once

#include <filesystem>

#include "radiosity/scene/photometry.h"

namespace io {

/// Writes the polar curve of a luminaire (polar_drawing) as SVG that needs nothing else. Throws
/// OutputError.
void write_polar_curve(const std::filesystem::path& path, const radiosity::Photometry& photometry);

}  // namespace io
