#include "viewer/work/file_watch.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLookInterval(1);

std::optional<FileStamp> stamp(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  FileStamp found{.path = path, .written = fs::last_write_time(path, error), .size = 0};
  if (error) return std::nullopt;
  found.size = fs::file_size(path, error);
  if (error) return std::nullopt;
  return found;
}

/// The first that is other than it was, but as in the last look: nobody is writing it any more.
std::optional<fs::path> first_changed(const std::vector<FileStamp>& read,
                                      const std::vector<FileStamp>& last,
                                      const std::vector<FileStamp>& now) {
  const auto has = [](const std::vector<FileStamp>& stamps, const FileStamp& wanted) {
    return std::find(stamps.begin(), stamps.end(), wanted) != stamps.end();
  };
  for (const FileStamp& found : now) {
    if (!has(read, found) && has(last, found)) return found.path;
  }
  return std::nullopt;
}

}  // namespace

std::vector<FileStamp> file_stamps(const std::vector<fs::path>& files) {
  std::vector<FileStamp> stamps;
  for (const fs::path& file : files) {
    const auto found = stamp(file);
    if (found && std::find(stamps.begin(), stamps.end(), *found) == stamps.end()) {
      stamps.push_back(*found);
    }
  }
  return stamps;
}

void FileWatch::watch(std::vector<FileStamp> stamps) {
  changed_.reset();
  worker_.start([this, read = std::move(stamps)](const Worker::Context& context) {
    std::vector<fs::path> files;
    for (const FileStamp& file : read) files.push_back(file.path);
    std::vector<FileStamp> last = read;
    for (;;) {
      rest(kLookInterval, context.progress.stop);
      context.progress.check();
      std::vector<FileStamp> now = file_stamps(files);
      if (const auto changed = first_changed(read, last, now)) {
        context.post([this, changed] { changed_ = changed; });
        return;
      }
      last = std::move(now);
    }
  });
}

}  // namespace viewer
