#pragma once

#include <string>
#include <string_view>

namespace apps::validation {

/// How wide plots and maps are, and the size of their sans-serif font.
inline constexpr double kSvgWidth = 480;
inline constexpr double kSvgFont = 12;

/// About how wide the text is in that font.
double text_width(std::string_view text);

/// The picture with this content, of elements, and a title that is not shown.
std::string svg_picture(std::string_view title, double height, std::string_view content);

}  // namespace apps::validation
