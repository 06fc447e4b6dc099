#include "apps/validation/plot/svg_text.h"

#include <algorithm>

namespace apps::validation {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

double text_width(std::string_view text, double font_size) {
  constexpr double kMeanAdvance = 0.54;  // of Helvetica, Arial, Liberation Sans, relative to size
  // Bytes 10xxxxxx continue a character of UTF-8.
  const auto n = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  });
  return kMeanAdvance * font_size * static_cast<double>(n);
}

}  // namespace apps::validation
