#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"

namespace io {

/// Throws SceneError "room.obj: message", in one line and without control characters.
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& message);

/// Size of a file, bytes, > 0. Throws SceneError if there is no such file, if it is no regular one
/// (a folder, a pipe, a device: reading could wait for ever), not readable or empty.
std::uint64_t input_size(const std::filesystem::path& path);

/// The number that `word` spells, the whole of it; a leading + is allowed. Empty if it spells none
/// or one that T cannot hold.
template <typename T>
std::optional<T> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// What stands between the commas of a line, each without blanks at both ends.
std::vector<std::string_view> comma_fields(std::string_view line);

/// Splits a line into the words between its blanks.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// The next word; empty if there is none.
  std::string_view next();
  /// All that was not read yet, without blanks at both ends.
  [[nodiscard]] std::string_view rest() const { return trimmed(rest_); }

 private:
  std::string_view rest_;
};

/// Reads a text file line by line and knows where it is. Lines may end in \n or \r\n. A byte order
/// mark of UTF-8 at the start is skipped; text in UTF-16 is refused.
class LineReader {
 public:
  /// Whether \ at the end joins the next line; not that of a comment, which ends with its line.
  enum class Continuation { none, backslash };

  /// Throws SceneError if the file cannot be read. `progress` must outlive the reader.
  LineReader(const std::filesystem::path& path, const radiosity::Progress& progress,
             Continuation continuation = Continuation::none);

  /// Goes to the next line. False at the end of the file. Throws Interrupted if asked to stop.
  bool next_line();
  /// Goes to the next line that is neither blank nor, from a `#` on, a comment; `line` is then
  /// without its comment. False at the end of the file.
  bool next_content();

  /// Goes to a byte of the file, whose line `next_line` is to read; lines are counted on.
  void skip_to(std::uint64_t offset);

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] long line_number() const { return first_line_number_; }
  /// Bytes of the file and bytes up to the end of the current line.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

  /// Throws SceneError "room.obj:41: message".
  [[noreturn]] void fail(const std::string& message) const;

  /// To be called once the file has shown that it is of the kind that is read.
  void recognise() { is_recognised_ = true; }
  /// A word of the file as messages tell it: in quotes and cut. Of a file that was not recognised
  /// only its length, since it may be anything, a file of passwords, say.
  [[nodiscard]] std::string shown(std::string_view word) const;

  /// The next word as a finite number, an integer, or three words as a point. `what` names it in
  /// the SceneError that is thrown if it is none.
  double number(Words& words, std::string_view what) const;
  std::int64_t integer(Words& words, std::string_view what) const;
  radiosity::Vec3 point(Words& words) const;

 private:
  bool read_physical_line(std::string& line);

  std::filesystem::path path_;
  const radiosity::Progress& progress_;
  Continuation continuation_;
  std::uint64_t size_;
  std::uint64_t offset_ = 0;
  std::vector<char> buffer_;
  std::ifstream file_;
  std::string line_;
  std::string joined_;
  bool is_recognised_ = false;
  long line_number_ = 0;        // physical lines read
  long first_line_number_ = 0;  // where the current, perhaps joined, line starts
};

}  // namespace io
