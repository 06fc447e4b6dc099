#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/base/byte_reader.h"
#include "io/base/line_reader.h"

namespace io {

/// The sections of a .msh file and the numbers in them, whether these are text or binary. Functions
/// throw SceneError with the line, of binary numbers the byte, where something stands that should
/// not.
class MshSource {
 public:
  /// Reads the file's first section, which tells its version and the kind of its numbers.
  /// `progress` must outlive the source.
  MshSource(const std::filesystem::path& path, const radiosity::Progress& progress);

  [[noreturn]] void fail(const std::string& message) const;

  [[nodiscard]] double version() const { return version_; }
  [[nodiscard]] bool is_binary() const { return is_binary_; }

  /// Goes to the next section; false at the end of the file. Then behind its end.
  bool next_section();
  void leave_section();
  [[nodiscard]] const std::string& section() const { return section_; }

  /// The next line of the section, also of a binary file.
  Words next_line();
  /// Begins what has a line for itself in text.
  void next_record();
  /// Numbers of a record: of 4 bytes, of 8, and floating; `what` names them in messages.
  std::int64_t integer(std::string_view what);
  std::int64_t large(std::string_view what);
  double number(std::string_view what);
  radiosity::Vec3 point();
  /// A number of things, >= 0, of 8 bytes; if binary, the file must have `bytes_each` for each.
  std::uint64_t count(std::string_view what, std::uint64_t bytes_each);
  /// The same of a line's words.
  std::int64_t integer(Words& words, std::string_view what) const {
    return lines_.integer(words, what);
  }
  std::uint64_t count(Words& words, std::string_view what, std::uint64_t bytes_each);

 private:
  void read_format();
  const char* take(std::uint64_t n, std::string_view what);
  std::uint64_t checked_count(std::int64_t n, std::string_view what, std::uint64_t bytes_each);

  std::filesystem::path path_;
  const radiosity::Progress& progress_;
  LineReader lines_;
  Words words_;                      // of the record
  std::optional<ByteReader> bytes_;  // while a section's binary numbers are read
  std::string section_;
  double version_ = 0;
  bool is_binary_ = false;
  std::endian order_ = std::endian::little;
};

}  // namespace io
