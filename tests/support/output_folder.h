#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

/// An empty folder for what a test writes, removed afterwards.
class OutputFolder : public testing::Test {
 public:
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// The names of the files in the folder, hidden ones too.
  [[nodiscard]] std::set<std::string> file_names() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

 protected:
  OutputFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "radiosity-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~OutputFolder() override { std::filesystem::remove_all(folder_); }

 private:
  std::filesystem::path folder_;
};

/// Makes another folder the current one while it lives.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::filesystem::path& folder)
      : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  std::filesystem::path before_;
};

/// While it lives, writing fails in any file beyond so many bytes, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t bytes) {
    before_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, before_handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*before_handler_)(int) = nullptr;
};
