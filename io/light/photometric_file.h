#pragma once

#include <filesystem>

#include "radiosity/base/progress.h"
#include "radiosity/scene/photometry.h"

namespace io {

/// Whether a file is one of luminaires by its extension: .ies or .ldt.
bool is_photometric_file(const std::filesystem::path& path);

/// Reads a photometric file by its extension. Warns where the file's own lumens are far from what
/// the intensities add up to, and where angles are left out. Throws SceneError with file and line.
radiosity::Photometry read_photometric_file(const std::filesystem::path& path,
                                            const radiosity::Progress& progress = {});

}  // namespace io
