#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/scene.h"

/// A test with a folder of its own for files, removed at the end.
class ScratchFiles : public testing::Test {
 protected:
  ScratchFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("radiosity_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFiles() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  /// Writes a file into the folder and returns its path.
  [[nodiscard]] std::filesystem::path file(const std::string& name,
                                           const std::string& content) const {
    // Removed first: some file systems write a file that was overwritten to disk at once.
    std::filesystem::remove(folder_ / name);
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  [[nodiscard]] radiosity::Scene read(const std::string& name, const std::string& content) const {
    return io::read_scene(file(name, content));
  }
  /// The message of the SceneError that reading throws; "" if it throws none.
  static std::string error_of(const std::filesystem::path& path,
                              const io::ReadOptions& options = {}) {
    try {
      (void)io::read_scene(path, options);
    } catch (const radiosity::SceneError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::string error_of(const std::string& name, const std::string& content) const {
    return error_of(file(name, content));
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

#define EXPECT_CONTAINS(text, part)                          \
  do {                                                       \
    const std::string& text_ = (text);                       \
    EXPECT_NE(text_.find(part), std::string::npos) << text_; \
  } while (false)

/// The bytes of a value in the given order.
template <typename T>
std::string bytes(T value, std::endian order = std::endian::little) {
  std::string result(sizeof(T), '\0');
  std::memcpy(result.data(), &value, sizeof(T));
  if (order != std::endian::native) result.assign(result.rbegin(), result.rend());
  return result;
}
