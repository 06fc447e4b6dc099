#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>

namespace radiosity {

/// A file that grows at its end and is read anywhere. What was appended is safe from the death of
/// this process. All failures throw OutputError with the file's name and the system's reason.
class WorkFile {
 public:
  /// Opens the file, making it if there is none, and locks it against other processes.
  explicit WorkFile(std::filesystem::path path);
  ~WorkFile();
  WorkFile(const WorkFile&) = delete;
  WorkFile& operator=(const WorkFile&) = delete;

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Cuts off everything from `size` on.
  void truncate(std::uint64_t size);
  /// Writes all bytes at the end and returns where they start; the file is as before if it throws.
  /// Callable from any thread.
  std::uint64_t append(std::span<const std::byte> bytes);
  /// Fills `bytes` from `offset` on; false if the file ends before. Callable from any thread.
  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> bytes) const;
  /// Removes the file from its folder.
  void remove() const;

 private:
  [[noreturn]] void fail(const char* what, int error) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::mutex mutex_;  // guards the end of the file
  std::uint64_t size_ = 0;
};

}  // namespace radiosity
