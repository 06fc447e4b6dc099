#pragma once

#include <string>
#include <string_view>

namespace apps::validation {

/// The text with & < > " as entities, fit for HTML and SVG.
std::string escaped(std::string_view text);

/// About how wide the text is in a sans-serif font of the given size, in the same unit.
double text_width(std::string_view text, double font_size);

}  // namespace apps::validation
