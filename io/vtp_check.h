#pragma once

#include <filesystem>

namespace io {

/// Looks through a VTK XML file for damage that VTK's reader does not survive: it follows a null
/// pointer for an unknown type, and asks for the memory that a damaged block claims to need. Throws
/// SceneError naming the file if it is no VTK PolyData, ends too early or has such damage. What
/// passes may be damaged in ways that VTK notices.
void check_vtp(const std::filesystem::path& path);

}  // namespace io
