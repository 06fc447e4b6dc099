#include "apps/run/work_file_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/extension.h"
#include "radiosity/base/error.h"

namespace apps {

using radiosity::WorkFileState;

std::filesystem::path work_file_path(const std::vector<std::string>& outputs) {
  const auto h5 = std::find_if(outputs.begin(), outputs.end(), [](const std::string& output) {
    return io::lower_case_extension(output) == ".h5";
  });
  return (h5 != outputs.end() ? *h5 : outputs.front()) + ".partial";
}

void check_work_file(const std::filesystem::path& path, WorkFileState state,
                     radiosity::WorkStart wanted, TerminalProgress& terminal) {
  const bool is_resumed = wanted == radiosity::WorkStart::resumed;
  if (is_resumed && state == WorkFileState::other) {
    throw radiosity::OutputError(
        fmt::format("{}: belongs to another scene or other options, so it cannot be resumed; "
                    "repeat them, or remove the file",
                    path.string()));
  }
  if (is_resumed || state == WorkFileState::absent) return;
  terminal.warn(
      fmt::format("{}{} is replaced; --resume would have continued it", path.string(),
                  state == WorkFileState::same ? "" : ", of another scene or with other options,"));
}

}  // namespace apps
