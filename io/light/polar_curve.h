#pragma once

#include <filesystem>
#include <string>

#include "radiosity/scene/photometry.h"

namespace io {

/// The polar curve of a luminaire (polar_drawing) as SVG that needs nothing else.
std::string polar_curve_svg(const radiosity::Photometry& photometry);

/// Writes it. Throws OutputError.
void write_polar_curve(const std::filesystem::path& path, const radiosity::Photometry& photometry);

}  // namespace io
