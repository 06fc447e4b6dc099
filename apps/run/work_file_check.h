#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/terminal/terminal_progress.h"
#include "radiosity/base/fingerprint.h"
#include "radiosity/stream/tile_store.h"

namespace apps {

/// Where the work file of a computation lies: beside the first .h5 file that it writes, else beside
/// its first output.
std::filesystem::path work_file_path(const std::vector<std::string>& outputs);

/// Checks that the work file that may be at `path` allows the wanted start. One that is to be
/// replaced by a new start causes a warning. Throws OutputError if it is to be resumed but belongs
/// to another computation, or if it is no work file at all.
void check_work_file(const std::filesystem::path& path, const radiosity::Fingerprint& fingerprint,
                     radiosity::TileStore::Start wanted, TerminalProgress& terminal);

}  // namespace apps
