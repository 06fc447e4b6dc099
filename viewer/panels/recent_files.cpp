#include "viewer/panels/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>

namespace viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 10;

}  // namespace

fs::path RecentFiles::default_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state != nullptr && *state != '\0') return fs::path(state) / "radiosity" / "recent";
  if (home == nullptr || *home == '\0') return {};
  return fs::path(home) / ".local" / "state" / "radiosity" / "recent";
}

RecentFiles::RecentFiles(fs::path file) : file_(std::move(file)) {
  std::ifstream stream(file_);
  for (std::string line; paths_.size() < kMostFiles && std::getline(stream, line);) {
    if (!line.empty()) paths_.push_back(line);
  }
}

void RecentFiles::add(const std::string& path) {
  std::error_code error;
  const fs::path full = fs::absolute(path, error);
  const std::string entry = (error ? fs::path(path) : full).lexically_normal().string();
  paths_.erase(std::remove(paths_.begin(), paths_.end(), entry), paths_.end());
  paths_.insert(paths_.begin(), entry);
  if (paths_.size() > kMostFiles) paths_.resize(kMostFiles);
  if (file_.empty()) return;
  fs::create_directories(file_.parent_path(), error);
  std::ofstream stream(file_);
  for (const std::string& line : paths_) stream << line << '\n';
}

}  // namespace viewer
