#pragma once

#include <filesystem>

#include "radiosity/base/progress.h"
#include "radiosity/scene/photometry.h"

namespace io {

/// Reads IES LM-63 of 1986 to 2019, types A, B and C, relative or absolute. A TILT table, inside or
/// in another file beside it, is checked and not applied: lamps burn as they were measured. Throws
/// SceneError with file and line.
radiosity::Photometry read_ies(const std::filesystem::path& path,
                               const radiosity::Progress& progress = {});

}  // namespace io
