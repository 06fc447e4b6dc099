#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viewer {

/// The files that were opened last, the latest first, kept in the user's folder for such things
/// ($XDG_STATE_HOME or ~/.local/state) from one run to the next.
class RecentFiles {
 public:
  /// Reads the list; empty if there is none. `file` is for tests.
  explicit RecentFiles(std::filesystem::path file = default_file());
  static std::filesystem::path default_file();

  [[nodiscard]] const std::vector<std::string>& paths() const { return paths_; }
  /// Puts a file first and keeps the list. That it cannot be kept is no error.
  void add(const std::string& path);

 private:
  std::filesystem::path file_;
  std::vector<std::string> paths_;
};

}  // namespace viewer
