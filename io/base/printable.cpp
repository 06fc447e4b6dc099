#include "io/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace io {
namespace {

constexpr std::size_t kLongestWord = 240;   // bytes; paths are seldom longer
constexpr std::size_t kLongestText = 2000;  // bytes
constexpr std::size_t kLongestQuoted = 40;  // bytes
constexpr std::string_view kGap = "...";

/// A character of UTF-8: its code and its length in bytes; 0 bytes if it is none.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 0;
};

/// The character that `text`, which is not empty, begins with (RFC 3629: no surrogates, nothing
/// longer than need be).
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t size = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < size) return {};
  std::uint32_t code = byte(0) & (0xFFU >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(k) & 0x3FU);
  }
  const bool is_short = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  if (is_short || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
  return {code, size};
}

/// Marks that change the direction of writing, and others that no reader sees.
bool is_invisible(std::uint32_t code) {
  return code == 0x061C || (code >= 0x200B && code <= 0x200F) ||
         (code >= 0x202A && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F) ||
         code == 0xFEFF || (code >= 0xFFF9 && code <= 0xFFFB) ||
         (code >= 0xE0000 && code <= 0xE007F);
}

bool is_space(std::uint32_t code) {
  return (code >= 0x09 && code <= 0x0D) || code == 0x85 || code == 0x2028 || code == 0x2029;
}

bool is_control(std::uint32_t code) { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

/// `text` with harmless characters in place of the others.
std::string without_controls(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto [code, size] = first_character(text);
    if (size == 0) {
      result += '?';
    } else if (is_space(code)) {
      result += ' ';
    } else if (is_control(code) || is_invisible(code)) {
      result += '?';
    } else {
      result += text.substr(0, size);
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return result;
}

/// The largest place up to `place` that is not within a character.
std::size_t boundary(std::string_view text, std::size_t place) {
  while (place > 0 && place < text.size() &&
         (static_cast<unsigned char>(text[place]) & 0xC0) == 0x80) {
    --place;
  }
  return place;
}

std::string cut_end(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  return fmt::format("{}{}", text.substr(0, boundary(text, most)), kGap);
}

/// The end is kept too: that of a path tells more than its middle.
std::string cut_middle(std::string_view word) {
  if (word.size() <= kLongestWord) return std::string(word);
  constexpr std::size_t kPart = kLongestWord / 2;
  return fmt::format("{}{}{}", word.substr(0, boundary(word, kPart)), kGap,
                     word.substr(boundary(word, word.size() - kPart)));
}

}  // namespace

std::string printable(std::string_view text) {
  const std::string clean = without_controls(text);
  std::string result;
  std::string_view rest = clean;
  while (!rest.empty() && result.size() <= kLongestText) {
    const std::size_t blank = std::min(rest.find(' '), rest.size());
    result += cut_middle(rest.substr(0, blank));
    rest.remove_prefix(blank);
    if (rest.empty()) break;
    result += ' ';
    rest.remove_prefix(1);
  }
  return cut_end(result, kLongestText);
}

std::string printable_json(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto [code, size] = first_character(text);
    const bool is_layout = code == '\n';
    if (size == 0 || is_layout || !(is_space(code) || is_control(code) || is_invisible(code))) {
      result += text.substr(0, std::max<std::size_t>(size, 1));
    } else if (code < 0x10000) {
      result += fmt::format("\\u{:04x}", code);
    } else {
      const std::uint32_t rest = code - 0x10000;
      result += fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + (rest >> 10), 0xDC00 + (rest & 0x3FF));
    }
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

std::string in_quotes(std::string_view word) {
  return fmt::format("\"{}\"", cut_end(without_controls(word), kLongestQuoted));
}

}  // namespace io
