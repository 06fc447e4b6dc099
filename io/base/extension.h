#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace io {

/// The extension of a file name with its dot, in lower case: ".obj" of "Room.OBJ".
inline std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace io
