#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/terminal/terminal_progress.h"
#include "radiosity/base/work_stamp.h"

namespace apps {

/// Where the work file of a computation lies: beside the first .h5 file that it writes, else beside
/// its first output.
std::filesystem::path work_file_path(const std::vector<std::string>& outputs);

/// Checks that the work file at `path`, whose state was found, allows the wanted start. One that is
/// to be replaced by a new start causes a warning. Throws OutputError if it is to be resumed but
/// belongs to another computation.
void check_work_file(const std::filesystem::path& path, radiosity::WorkFileState state,
                     radiosity::WorkStart wanted, TerminalProgress& terminal);

}  // namespace apps
