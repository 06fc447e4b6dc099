#pragma once

#include <filesystem>
#include <functional>

namespace io {

/// Calls `write_to` with the name of a temporary file beside `path`, then renames it to `path`, so
/// that `path` is either the old file or the whole new one. The temporary file is removed if
/// `write_to` throws. Throws OutputError if the folder is missing or not writable, or the rename
/// fails (the message names `path` and the system's reason).
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write_to);

}  // namespace io
