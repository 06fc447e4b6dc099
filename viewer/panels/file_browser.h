#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viewer/panels/dialog_keys.h"

namespace viewer {

/// Whether a file is a scene or a result by its name.
bool is_listed(const std::filesystem::path& path);

/// A popup to choose a file to open: folders and files that the program reads.
class FileBrowser {
 public:
  /// Opens the popup with the next `draw`, in the folder of `path`.
  void open(const std::string& path);
  /// Draws it, if it is open; returns the file that was chosen. Enter opens what is named, Esc
  /// cancels.
  std::optional<std::string> draw(const DialogKeys& keys, double scale);

 private:
  void enter(const std::filesystem::path& folder);
  /// Goes where the text says: into a folder, or returns the file.
  std::optional<std::string> follow_text();
  /// What was clicked twice, or a folder that was clicked is entered.
  std::optional<std::string> draw_entries();

  bool is_due_ = false;
  std::string text_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> entries_;  // folders first
};

}  // namespace viewer
