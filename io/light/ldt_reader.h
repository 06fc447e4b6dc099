#pragma once

#include <filesystem>

#include "radiosity/base/progress.h"
#include "radiosity/scene/photometry.h"

namespace io {

/// Reads EULUMDAT (.ldt) of any symmetry. Of several sets of lamps the first counts. Throws
/// SceneError with file and line.
radiosity::Photometry read_ldt(const std::filesystem::path& path,
                               const radiosity::Progress& progress = {});

}  // namespace io
