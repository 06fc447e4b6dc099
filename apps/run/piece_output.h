#pragma once

#include <filesystem>

#include "io/result/result_file.h"
#include "radiosity/base/ranks.h"

namespace apps {

/// Whether the file is one of which each rank writes a piece (.pvtp).
bool is_in_pieces(const std::filesystem::path& path);

/// Writes such a file, of all ranks together: each its piece beside it, and once all are there the
/// first the file that names them. One that was there before goes first, for its pieces do. Throws
/// OutputError.
void write_in_pieces(const std::filesystem::path& path, radiosity::Ranks& ranks,
                     const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                     const io::ResultOptions& options);

}  // namespace apps
