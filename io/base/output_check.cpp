#include "io/base/output_check.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>

#include "io/base/temporary_file.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using radiosity::OutputError;

constexpr int kMostLinks = 40;  // as the system allows in a row

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw OutputError(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Where a link that leads to nothing yet would lead; another path as it is.
fs::path without_links(fs::path path) {
  std::error_code error;
  for (int k = 0; k < kMostLinks && fs::is_symlink(path, error); ++k) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = folder_of(path) / target;
  }
  return path;
}

std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

void check_folder(const fs::path& path, const fs::path& folder) {
  const auto status = status_of(folder);
  if (!status && errno == ENOENT) {
    refuse(path, fmt::format("there is no folder {}", folder.string()));
  }
  if (!status) refuse(path, fmt::format("folder {}: {}", folder.string(), std::strerror(errno)));
  if (!S_ISDIR(status->st_mode)) refuse(path, fmt::format("{} is not a folder", folder.string()));
}

/// What stands in the way of replacing a file that is there.
void check_replaceable(const fs::path& path, const fs::path& target, const struct stat& status) {
  if (S_ISDIR(status.st_mode)) refuse(path, "it is a folder");
  if (!S_ISREG(status.st_mode)) refuse(path, "it is not a regular file");
  // Renaming would go over the protection of a file, and `access` does so for the superuser.
  constexpr mode_t kWritable = S_IWUSR | S_IWGRP | S_IWOTH;
  if ((status.st_mode & kWritable) == 0) refuse(path, "it is write-protected");
  if (::access(target.c_str(), W_OK) != 0) refuse(path, std::strerror(errno));
  const uid_t user = ::geteuid();
  const auto folder = status_of(folder_of(target));
  const bool is_sticky = folder && (folder->st_mode & S_ISVTX) != 0;
  if (is_sticky && user != 0 && status.st_uid != user && folder->st_uid != user) {
    refuse(path, "it belongs to another user");
  }
}

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace

fs::path replaced_file(const fs::path& path) {
  if (!path.has_filename()) refuse(path, "expected the name of a file");
  const auto status = status_of(path);
  if (!status && errno != ENOENT && errno != ENOTDIR) refuse(path, std::strerror(errno));
  if (!status) {
    fs::path target = without_links(path);
    check_folder(path, folder_of(target));
    return target;
  }
  std::error_code error;
  const fs::path resolved = fs::canonical(path, error);
  const fs::path target = error ? path : resolved;
  check_replaceable(path, target, *status);
  return target;
}

void check_writable(const fs::path& path) {
  const fs::path target = replaced_file(path);
  remove_stale_files(folder_of(target));
  const TemporaryFile probe(folder_of(target), path);
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  const auto a_status = status_of(a);
  const auto b_status = status_of(b);
  if (a_status && b_status) return is_same(*a_status, *b_status);
  if (a_status || b_status) return false;
  const fs::path a_target = without_links(a);
  const fs::path b_target = without_links(b);
  if (a_target.filename() != b_target.filename()) return false;
  const auto a_folder = status_of(folder_of(a_target));
  const auto b_folder = status_of(folder_of(b_target));
  return a_folder && b_folder && is_same(*a_folder, *b_folder);
}

void check_not_input(const fs::path& output, std::span<const fs::path> inputs) {
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    if (!is_same_file(output, inputs[k])) continue;
    refuse(output, fmt::format("it is {}, which the scene refers to", inputs[k].string()));
  }
}

}  // namespace io
