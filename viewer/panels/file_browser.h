#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viewer {

/// A popup to choose a file to open: folders and files that the program reads.
class FileBrowser {
 public:
  /// Opens the popup with the next `draw`, in the folder of `path`.
  void open(const std::string& path);
  /// Draws it, if it is open; returns the file that was chosen.
  std::optional<std::string> draw(double scale);

 private:
  void enter(const std::filesystem::path& folder);

  bool is_due_ = false;
  std::string text_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> entries_;  // folders first
};

}  // namespace viewer
