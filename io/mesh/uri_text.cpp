#include "io/mesh/uri_text.h"

#include <charconv>
#include <cstdint>

namespace io {
namespace {

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

}  // namespace

std::optional<std::string> decode_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6U | static_cast<std::uint32_t>(digit)) & 0xffffU;
    n_bits += 6;
    if (n_bits >= 8) bytes += static_cast<char>(bits >> static_cast<unsigned>(n_bits -= 8) & 0xffU);
  }
  return bytes;
}

std::string decode_percent(std::string_view uri) {
  std::string text;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    int value = 0;
    const char* const digits = uri.data() + k + 1;
    if (uri[k] == '%' && k + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      text += static_cast<char>(value);
      k += 2;
    } else {
      text += uri[k];
    }
  }
  return text;
}

}  // namespace io
