#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "radiosity/base/progress.h"

namespace io {

/// The value of type T whose bytes stand at `bytes` in the given order.
template <typename T>
T load(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> copy;
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    copy[k] = bytes[order == std::endian::native ? k : sizeof(T) - 1 - k];
  }
  return std::bit_cast<T>(copy);
}

/// Reads a binary file from a given byte to its end.
class ByteReader {
 public:
  /// Throws SceneError if the file cannot be read. `progress` must outlive the reader.
  ByteReader(const std::filesystem::path& path, std::uint64_t offset,
             const radiosity::Progress& progress);

  /// The next n bytes, valid until the next call. Throws SceneError telling the bytes found and
  /// expected if the file ends before; Interrupted if asked to stop.
  const char* take(std::uint64_t n);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

 private:
  void refill(std::uint64_t n);

  std::filesystem::path path_;
  const radiosity::Progress& progress_;
  std::uint64_t size_;
  std::uint64_t offset_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // of the bytes in the buffer that were not taken yet
  std::size_t end_ = 0;
};

}  // namespace io
