#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "radiosity/error.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using radiosity::OutputError;

/// A new, empty file in a folder, removed at the end unless it was renamed.
class TemporaryFile {
 public:
  TemporaryFile(const fs::path& folder, const fs::path& target) {
    // The name does not contain the target's, which may be as long as the file system allows.
    // O_EXCL claims it against other processes and shows early whether the folder can be written.
    for (int attempt = 0;; ++attempt) {
      path_ = folder / fmt::format(".radiosity-{}-{}.tmp", ::getpid(), attempt);
      const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0) {
        ::close(descriptor);
        return;
      }
      if (errno != EEXIST) {
        throw OutputError(fmt::format("{}: cannot create a file in folder '{}': {}",
                                      target.string(), folder.string(), std::strerror(errno)));
      }
    }
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The file that is to be replaced: `path` itself, or what it links to.
fs::path replaced_file(const fs::path& path) {
  if (!path.has_filename()) {
    throw OutputError(fmt::format("'{}': expected the name of a file", path.string()));
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return path;
  if (fs::is_directory(status)) {
    throw OutputError(fmt::format("{}: is a folder, expected the name of a file", path.string()));
  }
  if (!fs::is_regular_file(status)) {
    throw OutputError(
        fmt::format("{}: is not a regular file, so it cannot be replaced", path.string()));
  }
  const fs::path resolved = fs::canonical(path, error);
  return error ? path : resolved;
}

}  // namespace

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write_to) {
  const fs::path target = replaced_file(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const TemporaryFile temporary(folder, path);
  write_to(temporary.path());

  std::error_code error;
  fs::rename(temporary.path(), target, error);
  if (error) {
    throw OutputError(fmt::format("{}: cannot put the finished file in place: {}", path.string(),
                                  error.message()));
  }
}

void write_stream_atomically(const fs::path& path,
                             const std::function<void(std::ofstream&)>& write_to) {
  write_atomically(path, [&](const fs::path& temporary) {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (stream) write_to(stream);
    stream.close();  // the last bytes may meet the full disk only here
    if (!stream) {
      throw OutputError(fmt::format("{}: cannot write: {}", path.string(),
                                    errno != 0 ? std::strerror(errno) : "unknown error"));
    }
  });
}

}  // namespace io
