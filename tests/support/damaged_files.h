#pragma once

#include <gtest/gtest.h>
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace radiosity::test {

inline std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  // Removed first: some file systems write a file that was overwritten to disk at once.
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What reading made of a file: the message if it threw, which must be one line that starts with
/// the path; empty if it opened.
template <typename Error>
std::string outcome(const std::filesystem::path& path,
                    const std::function<void(const std::filesystem::path&)>& read) {
  try {
    read(path);
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(path.string(), 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "neither opened nor threw an error of ours: " << error.what();
  }
  return "";
}

/// The message that reading throws, of the expected kind; a failure if it opens.
template <typename Error>
std::string refusal(const std::filesystem::path& path,
                    const std::function<void(const std::filesystem::path&)>& read) {
  std::string message = outcome<Error>(path, read);
  EXPECT_FALSE(message.empty()) << path << " opened";
  return message;
}

/// While it lives, what is lost is not reported: the error paths of VTK and HDF5 lose
/// some objects.
class LeaksAllowed {
#if defined(__SANITIZE_ADDRESS__)
  __lsan::ScopedDisabler disabler_;
#endif
};

/// `bytes` with one bit or the whole of one byte changed, within [first, last).
inline std::string with_flip(std::string bytes, std::size_t first, std::size_t last,
                             std::mt19937_64& random) {
  const std::size_t place = first + random() % (last - first);
  const auto change = random() % 2 == 0 ? 1U << random() % 8 : 1U + random() % 255;
  bytes[place] = static_cast<char>(static_cast<unsigned char>(bytes[place]) ^ change);
  return bytes;
}

}  // namespace radiosity::test
