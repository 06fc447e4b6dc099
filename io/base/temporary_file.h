#pragma once

#include <sys/types.h>

#include <filesystem>

namespace io {

/// A new, empty file in a folder, removed at the end unless it was put in place. While it lives it
/// is locked (flock), so that other runs know that it is in use: whatever kills the program frees
/// the lock, and the next run that writes to the folder removes the file.
class TemporaryFile {
 public:
  /// For a file that is to become `target`, which messages name. Throws OutputError.
  TemporaryFile(const std::filesystem::path& folder, const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Brings what was written under its name to the disk and renames it to `target`, whose
  /// permissions it takes over if it is there. Throws OutputError (a full disk, too).
  void put_in_place(const std::filesystem::path& target);

 private:
  std::filesystem::path path_;
  std::filesystem::path shown_;  // for messages
  int descriptor_ = -1;
};

/// Removes the files that killed runs of this user have left in a folder. Those of runs that are
/// still going on are locked and stay. Never fails: what cannot be removed stays.
void remove_stale_files(const std::filesystem::path& folder);

}  // namespace io
