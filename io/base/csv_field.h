#pragma once

#include <string>
#include <string_view>

namespace io {

/// Whether a spreadsheet would not take the text as such: it begins a formula, after any number of
/// apostrophes.
inline bool begins_formula(const std::string& text) {
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string::npos &&
         std::string_view("=+-@\t\r\n").find(text[first]) != std::string_view::npos;
}

/// A text field as RFC 4180 wants it: in quotes if it holds a separator, inner quotes doubled. One
/// that spreadsheets would take for a formula gets an apostrophe in front, and one that already
/// has apostrophes before = + - @, tab or line end gets one more, so that taking one away from what
/// then looks like this gives the text again (`csv_text`).
inline std::string csv_field(const std::string& given) {
  const std::string text = begins_formula(given) ? "'" + given : given;
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// The text that a field stands for, once a reader of RFC 4180 has taken the quotes away.
inline std::string csv_text(const std::string& value) {
  return value.starts_with('\'') && begins_formula(value) ? value.substr(1) : value;
}

}  // namespace io
