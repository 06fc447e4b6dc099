#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace io {

/// The words and values of a legacy VTK file, one after another. Functions throw SceneError with
/// the line, of a binary file the byte, where something stands that should not.
class VtkLegacySource {
 public:
  /// Reads the file, and its first lines up to whether it is text or binary.
  explicit VtkLegacySource(const std::filesystem::path& path);

  [[noreturn]] void fail(const std::string& message) const;

  /// Of the format, 4.2 or 5.1, say.
  [[nodiscard]] double version() const { return version_; }
  [[nodiscard]] bool is_binary() const { return is_binary_; }
  /// Whether only blanks are left.
  [[nodiscard]] bool is_at_end() const;

  /// The next word; `what` names it in messages.
  std::string_view word(std::string_view what);
  /// The same in lower case, for keywords may be written in any.
  std::string keyword(std::string_view what);
  /// The next word, with the characters that %20 and the like stand for.
  std::string name(std::string_view what);
  /// A number of things, at most as many as can be numbered.
  std::uint64_t count(std::string_view what);
  /// What is left of the line, and the same going behind its end.
  [[nodiscard]] std::string_view rest_of_line() const;
  std::string_view line();

  /// `n` values of a legacy type, whose names are in lower case ("float"), as `VtpArray::bytes`; of
  /// bits nothing. `what` names them in messages.
  std::string values(const std::string& type, std::uint64_t n, std::string_view what);

 private:
  [[nodiscard]] std::size_t next_word() const;
  std::string_view take(std::uint64_t n, std::string_view what);
  std::string texts(std::uint64_t n, std::string_view what);

  std::filesystem::path path_;
  std::string content_;
  std::size_t place_ = 0;
  double version_ = 0;
  bool is_binary_ = false;
};

/// VTK XML's name of a legacy type ("float": "Float32", "string": "String"); empty for "bit", whose
/// values are not read, and for those that there are not.
std::string vtk_type_of_legacy(const std::string& type);

}  // namespace io
