#pragma once

#include <filesystem>

#include "radiosity/scene/photometry.h"

namespace io {

/// Writes the polar curve of a luminaire as `write_polar_curve` draws it, as .png. Not for two
/// threads at once. Throws OutputError.
void write_polar_picture(const std::filesystem::path& path,
                         const radiosity::Photometry& photometry);

}  // namespace io
