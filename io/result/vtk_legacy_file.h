#pragma once

#include <filesystem>

#include "io/result/vtp_file.h"

namespace io {

/// Reads a legacy VTK file (.vtk, versions 1 to 5.1), text or binary: polygon data or an
/// unstructured grid. Values at points are left out. As with VTK XML, all numbers are checked
/// against each other and against what the file can hold before anything is allocated. Throws
/// SceneError naming `path` and the line, of a binary file the byte.
VtpFile read_vtk_legacy(const std::filesystem::path& path);

}  // namespace io
