#include "radiosity/base/work_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "radiosity/base/error.h"

namespace radiosity {

WorkFile::WorkFile(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot open", errno);
  struct stat status {};
  const bool is_ours = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  const int lock_error = errno;
  if (!is_ours || ::fstat(descriptor_, &status) != 0) {
    ::close(descriptor_);
    if (is_ours) fail("cannot read", errno);
    if (lock_error == EWOULDBLOCK) throw OutputError(path_.string() + ": another run is using it");
    fail("cannot lock", lock_error);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

WorkFile::~WorkFile() { ::close(descriptor_); }

void WorkFile::fail(const char* what, int error) const {
  throw OutputError(path_.string() + ": " + what + ": " + std::strerror(error));
}

void WorkFile::truncate(std::uint64_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail("cannot write", errno);
  size_ = size;
}

std::uint64_t WorkFile::append(std::span<const std::byte> bytes) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t start = size_;
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done,
                               static_cast<off_t>(start + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      [[maybe_unused]] const int cut = ::ftruncate(descriptor_, static_cast<off_t>(start));
      fail("cannot write", error);
    }
    done += static_cast<std::size_t>(n);
  }
  size_ = start + bytes.size();
  return start;
}

bool WorkFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t n = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("cannot read", errno);
    if (n == 0) return false;
    offset += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

void WorkFile::remove() const {
  if (::unlink(path_.c_str()) != 0) fail("cannot remove", errno);
}

}  // namespace radiosity
