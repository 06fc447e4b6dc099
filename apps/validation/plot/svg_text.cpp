#include "apps/validation/plot/svg_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/xml_escaped.h"

namespace apps::validation {

double text_width(std::string_view text) {
  constexpr double kMeanAdvance = 0.54;  // of Helvetica, Arial, Liberation Sans, relative to size
  // Bytes 10xxxxxx continue a character of UTF-8.
  const auto n = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  });
  return kMeanAdvance * kSvgFont * static_cast<double>(n);
}

std::string svg_picture(std::string_view title, double height, std::string_view content) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {:.0f}" role="img" )"
      R"(font-family="Helvetica,Arial,sans-serif" font-size="{}" fill="#222">)"
      "<title>{}</title>{}</svg>",
      kSvgWidth, height, kSvgFont, io::xml_escaped(title), content);
}

}  // namespace apps::validation
