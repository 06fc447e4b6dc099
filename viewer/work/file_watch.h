#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "viewer/work/worker.h"

namespace viewer {

/// What a file was like: enough to see that it has been written again.
struct FileStamp {
  std::filesystem::path path;
  std::filesystem::file_time_type written = {};
  std::uintmax_t size = 0;  ///< bytes

  bool operator==(const FileStamp&) const = default;
};

/// Of each file once, in that order; of what is no file none.
std::vector<FileStamp> file_stamps(const std::vector<std::filesystem::path>& files);

/// Looks once a second, on its own thread, since disks may be far away, whether files are still
/// what they were when they were read.
class FileWatch {
 public:
  /// Begins to watch these, as they were; no others any more.
  void watch(std::vector<FileStamp> stamps);
  /// Takes in what was seen; whether that is new.
  bool update() { return worker_.deliver(); }
  /// The first one that has been written again, and not since the look before; absent if none has.
  /// One that is gone may be about to be replaced: it has not changed until it is there again.
  [[nodiscard]] const std::optional<std::filesystem::path>& changed() const { return changed_; }

 private:
  std::optional<std::filesystem::path> changed_;
  Worker worker_;
};

}  // namespace viewer
