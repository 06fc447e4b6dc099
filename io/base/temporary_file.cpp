#include "io/base/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

#include "radiosity/base/error.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using radiosity::OutputError;

constexpr std::string_view kStart = ".radiosity-";
constexpr std::string_view kEnd = ".tmp";

/// Whether a file may be one of ours by its name, ".radiosity-<pid>-<number>.tmp".
bool is_our_name(std::string_view name) {
  if (!name.starts_with(kStart) || !name.ends_with(kEnd)) return false;
  name.remove_prefix(kStart.size());
  name.remove_suffix(std::min(kEnd.size(), name.size()));
  const std::size_t dash = name.find('-');
  const auto is_number = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return dash != std::string_view::npos && is_number(name.substr(0, dash)) &&
         is_number(name.substr(dash + 1));
}

/// Locks a file just made. False if another run took it for a stale one and removed it before.
bool lock_new(int descriptor) {
  // Some file systems have no locks: others can then not lock it either, and leave it alone.
  while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
  }
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

void remove_if_stale(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status {};
  const bool is_ours =
      ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
  if (is_ours && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    // Whoever held the lock may have put the file in place since, and another may have made one of
    // this name.
    struct stat named {};
    if (::lstat(path.c_str(), &named) == 0 && named.st_ino == status.st_ino &&
        named.st_dev == status.st_dev) {
      ::unlink(path.c_str());
    }
  }
  ::close(descriptor);
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& folder, const fs::path& target) : shown_(target) {
  // The name does not contain the target's, which may be as long as the file system allows.
  // O_EXCL claims it against other processes and shows early whether the folder can be written.
  for (int attempt = 0;; ++attempt) {
    path_ = folder / fmt::format("{}{}-{}{}", kStart, ::getpid(), attempt, kEnd);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0 && lock_new(descriptor_)) return;
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    } else if (errno != EEXIST) {
      throw OutputError(fmt::format("{}: cannot create a file in folder '{}': {}", target.string(),
                                    folder.string(), std::strerror(errno)));
    }
  }
}

TemporaryFile::~TemporaryFile() {
  // Once it is in place, there is none of this name that is ours.
  if (!path_.empty()) ::unlink(path_.c_str());
  ::close(descriptor_);
}

void TemporaryFile::put_in_place(const fs::path& target) {
  const auto fail = [&](const char* what) {
    throw OutputError(fmt::format("{}: {}: {}", shown_.string(), what, std::strerror(errno)));
  };
  struct stat replaced {};
  if (::stat(target.c_str(), &replaced) == 0) {
    constexpr mode_t kPermissions = S_IRWXU | S_IRWXG | S_IRWXO;
    (void)::fchmod(descriptor_, replaced.st_mode & kPermissions);
  }
  // Some file systems tell only now that the disk is full; and a name must not reach the disk
  // before its content.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS) fail("cannot write");
  if (::rename(path_.c_str(), target.c_str()) != 0) fail("cannot put the finished file in place");
  path_.clear();
}

void remove_stale_files(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_our_name(entry->path().filename().native())) remove_if_stale(entry->path());
  }
}

}  // namespace io
