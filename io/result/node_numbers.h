#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/progress.h"

namespace io {

/// Reads the numbers that surfaces have as nodes of a thermal model from lines `surface,node`, of
/// which the first may be just that; a name with a comma stands in quotes. Every one of `surfaces`
/// must have a number of its own, above 0. Returns them in the order of `surfaces`. Throws
/// SceneError, with the line; Interrupted.
std::vector<std::int64_t> read_node_numbers(const std::filesystem::path& path,
                                            const std::vector<std::string>& surfaces,
                                            const radiosity::Progress& progress = {});

}  // namespace io
