#pragma once

#include <filesystem>
#include <vector>

namespace io {

/// The files that a glTF file (.gltf or .glb) names as its buffers and images, there or not. For
/// one that is no glTF, or names none, nothing.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path);

}  // namespace io
