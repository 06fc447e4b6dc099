#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace io {

/// Calls `write_to` with the name of a temporary file beside `path`, then renames it to `path`, so
/// that `path` is either the old file or the whole new one. The temporary file is removed if
/// `write_to` throws, and those that killed runs have left in the folder are removed first. If
/// `path` is a link to a file, that file is replaced and the link kept. Throws OutputError for what
/// `replaced_file` refuses, if the folder is not writable, or if the file cannot be brought to the
/// disk and renamed (the message names `path` and the system's reason).
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write_to);

/// The same for a writer to a binary stream. Throws OutputError also if anything that the writer
/// put into the stream did not reach the file (a full disk).
void write_stream_atomically(const std::filesystem::path& path,
                             const std::function<void(std::ofstream&)>& write_to);

}  // namespace io
