#include "io/base/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "io/base/output_check.h"
#include "io/base/temporary_file.h"
#include "radiosity/base/error.h"

namespace io {

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write_to) {
  const std::filesystem::path target = replaced_file(path);
  const auto folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  remove_stale_files(folder);
  TemporaryFile temporary(folder, path);
  write_to(temporary.path());
  temporary.put_in_place(target);
}

void write_stream_atomically(const std::filesystem::path& path,
                             const std::function<void(std::ofstream&)>& write_to) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (stream) write_to(stream);
    stream.close();  // the last bytes may meet the full disk only here
    if (!stream) {
      throw radiosity::OutputError(
          fmt::format("{}: cannot write: {}", path.string(),
                      errno != 0 ? std::strerror(errno) : "unknown error"));
    }
  });
}

}  // namespace io
