#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace io {

/// The file that writing to `path` replaces: `path` itself or, if it is a link, what that leads to.
/// Throws OutputError if it cannot be replaced: if it has no name, is a folder, no regular file,
/// write-protected, or of another user in a folder where that forbids it, or if its folder is not
/// there or not one.
std::filesystem::path replaced_file(const std::filesystem::path& path);

/// Finds out before the work whether a file can be written at `path`, by writing an empty one
/// beside it, which is removed. Throws OutputError that says why not. Removes what killed runs
/// left in that folder.
void check_writable(const std::filesystem::path& path);

/// Whether both names mean the same file, by whatever links and spelling; files that are not there
/// yet are the same if they would be.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws OutputError if `output` is one of `inputs`, which would be lost.
void check_not_input(const std::filesystem::path& output,
                     std::span<const std::filesystem::path> inputs);

}  // namespace io
